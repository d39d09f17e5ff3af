// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include <CLI/CLI.hpp>

#include "evaluate/blender_export.h"
#include "scene/gltf_loader.h"

namespace bounce::cli {

// Adds --blender to a subcommand that takes a scene; pass the options to resolve_scene() with the scene
// the user named. The options must live as long as the app.
void add_scene_source_options(CLI::App& command, SceneSourceOptions& options);

// Loads the scene the user named; a .blend is exported first. load_ms, where given, is the time of loading
// without the export. Throws what resolve_scene() and scene::load_gltf() throw.
[[nodiscard]] scene::LoadResult load_scene(const std::filesystem::path& scene,
                                           const SceneSourceOptions& options, double* load_ms = nullptr);

}  // namespace bounce::cli
