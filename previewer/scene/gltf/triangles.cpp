// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/triangles.h"

#include <tiny_gltf.h>

namespace bounce::scene::gltf {

std::vector<uint32_t> triangle_list(std::vector<uint32_t> indices, int mode) {
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        indices.resize(indices.size() / 3 * 3);
        return indices;
    }
    std::vector<uint32_t> triangles;
    if (indices.size() < 3) {
        return triangles;
    }
    triangles.reserve((indices.size() - 2) * 3);
    for (size_t i = 0; i + 2 < indices.size(); ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
            // Every second triangle of a strip runs the other way round.
            const size_t odd = i % 2;
            triangles.insert(triangles.end(), {indices[i], indices[i + 1 + odd], indices[i + 2 - odd]});
        } else {
            triangles.insert(triangles.end(), {indices[i + 1], indices[i + 2], indices[0]});
        }
    }
    return triangles;
}

}  // namespace bounce::scene::gltf
