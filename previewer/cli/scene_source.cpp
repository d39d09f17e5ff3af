// SPDX-License-Identifier: Apache-2.0
#include "cli/scene_source.h"

namespace bounce::cli {

void add_scene_source_options(CLI::App& command, SceneSourceOptions& options) {
    command.add_option("--blender", options.blender,
                       "Blender to export a .blend with (otherwise $BLENDER, then blender on PATH)");
}

}  // namespace bounce::cli
