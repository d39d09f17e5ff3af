// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "evaluate/blender_export.h"

namespace bounce::cli {

// Adds --blender to a subcommand that takes a scene; pass the options to resolve_scene() with the scene
// the user named. The options must live as long as the app.
void add_scene_source_options(CLI::App& command, SceneSourceOptions& options);

}  // namespace bounce::cli
