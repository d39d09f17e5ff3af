// SPDX-License-Identifier: Apache-2.0
//
// One file a subcommand. Each function adds its subcommand to the app and sets `run`, called after a
// successful parse, which returns the exit code or throws bounce::Error.
#pragma once

#include <functional>

#include <CLI/CLI.hpp>

#include "core/error.h"

namespace bounce::cli {

using Run = std::function<ExitCode()>;

void add_render(CLI::App& app, Run& run);
void add_compare(CLI::App& app, Run& run);
void add_convert(CLI::App& app, Run& run);
void add_view(CLI::App& app, Run& run);
void add_info(CLI::App& app, Run& run);
void add_evaluate(CLI::App& app, Run& run);
void add_bench(CLI::App& app, Run& run);

}  // namespace bounce::cli
