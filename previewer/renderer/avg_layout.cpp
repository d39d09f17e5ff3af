// SPDX-License-Identifier: Apache-2.0
#include "renderer/avg_layout.h"

#include <algorithm>
#include <cmath>

namespace bounce {
namespace {

constexpr long long k_faces = 32;

// Bytes of one surface in the largest of the grid's buffers.
constexpr long long k_surface_bytes =
    std::max<long long>(AVG_SUM_WORDS * sizeof(uint32_t), sizeof(gpu::GpuAvgVoxel));

}  // namespace

long long avg_surfaces(int size) {
    return k_faces * size * size;
}

int most_avg_size(long long block_bytes) {
    // Six faces of single surfaces.
    const double faces = static_cast<double>(block_bytes) / static_cast<double>(k_surface_bytes) / 6.0;
    return static_cast<int>(std::sqrt(std::max(faces, 0.0)));
}

gpu::AvgUniforms avg_layout(const scene::Bounds& first, const scene::Bounds& pose,
                            const gpu::RenderSpace& space, int size, long long block_bytes) {
    const scene::Bounds& now = pose.empty() ? first : pose;
    const scene::Bounds& base = first.empty() ? now : first;
    gpu::AvgUniforms out{};
    out.size = {1, 1, 1, 1};
    out.sides = {6, 4, 0, 0};
    out.origin = glm::vec4(-0.5F, -0.5F, -0.5F, 1.0F);
    if (now.empty()) {
        return out;
    }
    const glm::dvec3 anchor = space.point(base.low);
    const glm::dvec3 extent = space.point(base.high) - anchor;
    const glm::dvec3 low = space.point(now.low);
    const glm::dvec3 high = space.point(now.high);
    // A point of a scene still has a voxel around it.
    double side = std::max({extent.x, extent.y, extent.z, 1e-6}) / std::max(size - 1, 1);
    glm::dvec3 begin;
    glm::dvec3 count;
    for (;; side *= 2.0) {
        // By half a voxel of the lattice's own beginning.
        begin = glm::floor((low - anchor) / side + 0.5);
        count = glm::floor((high - anchor) / side + 0.5) - begin + 1.0;
        if (std::max({count.x, count.y, count.z}) <= size) {
            break;
        }
    }
    out.origin = glm::vec4(glm::vec3(anchor + (begin - 0.5) * side), static_cast<float>(side));
    const glm::ivec3 cells(count);
    const long long all = 3LL * cells.x * cells.y * cells.z;
    const long long room = std::min({avg_surfaces(size), all, block_bytes / k_surface_bytes});
    out.size = glm::ivec4(cells, static_cast<int>(std::max(room, 1LL)));
    return out;
}

}  // namespace bounce
