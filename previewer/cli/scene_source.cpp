// SPDX-License-Identifier: Apache-2.0
#include "cli/scene_source.h"

namespace bounce::cli {

void add_scene_source_options(CLI::App& command, SceneSourceOptions& options) {
    command.add_option("--blender", options.blender,
                       "Blender to export a .blend with (otherwise $BLENDER, then blender on PATH)");
}

scene::LoadResult load_scene(const std::filesystem::path& scene, const SceneSourceOptions& options) {
    scene::LoadResult result = scene::load_gltf(resolve_scene(scene, options).gltf);
    result.scene.name = scene.filename().string();  // not the exported file's in the cache
    return result;
}

}  // namespace bounce::cli
