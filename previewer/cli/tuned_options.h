// SPDX-License-Identifier: Apache-2.0
//
// --budget-ms and --tuning: options that a measured file gives in the place of the command line.
#pragma once

#include <CLI/CLI.hpp>

#include "cli/render_options.h"

namespace bounce::cli {

// The options as if the file's settings for the budget stood before what was typed: an option that was typed
// counts. Without --tuning the options themselves. Throws usage_error where --tuning is given without
// --budget-ms, where the latter is beside another preset than auto, or where what was typed goes with no
// setting of the file; input_error where the file cannot be used, has an option that does not exist or is not
// one of how light is drawn, or has no budget so short. Says on stderr which settings are taken. command: the
// subcommand that `typed` was parsed by.
[[nodiscard]] RenderOptions with_tuning(const CLI::App& command, const RenderOptions& typed);

// Says on stderr where the file was measured at another size or on another processor: its times are not ours
// then.
void note_other_conditions(const RenderOptions& options, const Settings& settings);

}  // namespace bounce::cli
