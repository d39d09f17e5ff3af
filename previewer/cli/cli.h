// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace bounce::cli {

// Parses the command line and runs the subcommand; returns the process's exit code (core/error.h).
int run(int argc, char** argv);

}  // namespace bounce::cli
