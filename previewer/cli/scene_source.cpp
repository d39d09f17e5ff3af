// SPDX-License-Identifier: Apache-2.0
#include "cli/scene_source.h"

#include "core/stopwatch.h"

namespace bounce::cli {

void add_scene_source_options(CLI::App& command, SceneSourceOptions& options) {
    command.add_option("--blender", options.blender,
                       "Blender to export a .blend with (otherwise $BLENDER, then blender on PATH)");
}

scene::LoadResult load_scene(const std::filesystem::path& scene, const SceneSourceOptions& options,
                             double* load_ms) {
    const ResolvedScene resolved = resolve_scene(scene, options);
    const Stopwatch loading;
    scene::LoadResult result = scene::load_gltf(resolved.gltf);
    if (load_ms != nullptr) {
        *load_ms = loading.ms();
    }
    result.scene.name = scene.filename().string();  // not the exported file's in the cache
    return result;
}

}  // namespace bounce::cli
