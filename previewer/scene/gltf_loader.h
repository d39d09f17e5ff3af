// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace bounce::scene {

struct LoadResult {
    Scene scene;
    std::vector<std::string> extensions_used;  // as the file lists them
    std::vector<std::string> warnings;  // features used by the file that are not carried, one sentence each
};

// Reads .glb or .gltf (external and embedded buffers and images, Draco). Throws input_error, one
// sentence that names the file and the cause, for anything it cannot read or that is not valid enough
// to be shown; never crashes on a malformed file.
[[nodiscard]] LoadResult load_gltf(const std::filesystem::path& path);

}  // namespace bounce::scene
