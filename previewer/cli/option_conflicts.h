// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/render_options.h"

namespace bounce::cli {

// Why an option that was given can have no effect beside the others, one sentence; empty where all have.
// settings: what the options amount to.
[[nodiscard]] std::string option_conflict(const RenderOptions& options, const Settings& settings);

}  // namespace bounce::cli
