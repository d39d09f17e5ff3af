// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace bounce::scene::gltf {

// The indices of a triangle list, strip or fan (mode as in glTF: 4, 5, 6) as a list, winding kept as in
// glTF 2.0, 3.7.2.1. Incomplete triangles at the end are dropped.
[[nodiscard]] std::vector<uint32_t> triangle_list(std::vector<uint32_t> indices, int mode);

}  // namespace bounce::scene::gltf
