// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include <nlohmann/json.hpp>

namespace bounce {

// What Bounce shows where a glTF file says nothing, so that Blender's renders of the file show the same:
//
//   camera_node   the node whose camera is looked through, whether the file names it or not
//   cameras       without any camera, of each frame: {frame, world_from_camera (four columns of four,
//   metres),
//                 yfov_rad, near_m, far_m}: the scene framed as scene::framing_camera() does
//   world         {color (linear), strength}: the sky that lights a file without light
//
// Null for a .blend and for what is no glTF, which the loader refuses. Throws what scene::load_gltf() throws.
[[nodiscard]] nlohmann::json scene_defaults(const std::filesystem::path& gltf, const std::vector<int>& frames,
                                            int width, int height);

}  // namespace bounce
