// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace bounce {

// Throws Error (failed) where the scene is a glTF file with meshes compressed by Draco and Blender would find
// no library to decode them: Blender itself ends with a Python error then. Looks where the add-on's
// draco_library.py looks, and where Blender's own builds have theirs. Nothing where the scene is a .blend or
// is not compressed.
void require_draco_library(const std::filesystem::path& scene, const std::filesystem::path& blender);

}  // namespace bounce
