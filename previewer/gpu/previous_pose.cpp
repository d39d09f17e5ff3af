// SPDX-License-Identifier: Apache-2.0
#include "gpu/previous_pose.h"

#include <map>
#include <utility>
#include <vector>

namespace bounce::gpu {
namespace {

// A draw's node and its place among that node's draws: the same at every moment.
using Identity = std::pair<int, int>;

std::vector<Identity> identities(const scene::Pose& pose) {
    std::map<int, int> count;
    std::vector<Identity> out;
    for (const scene::DrawInstance& instance : pose.draws) {
        out.emplace_back(instance.node, count[instance.node]++);
    }
    return out;
}

}  // namespace

void PreviousPose::keep_positions(const VertexStore& vertices) {
    const gl::Buffer& source = vertices.positions();
    if (positions_.bytes() != source.bytes()) {
        positions_ = gl::Buffer("previous positions", source.bytes(), 0);
    }
    glCopyNamedBufferSubData(source.id(), positions_.id(), 0, 0, static_cast<GLsizeiptr>(source.bytes()));
}

void PreviousPose::match_draws(const GpuScene& scene, const scene::Pose& now, const scene::Pose& before) {
    std::map<Identity, const scene::DrawInstance*> drawn;
    const std::vector<Identity> then = identities(before);
    for (size_t i = 0; i < then.size(); ++i) {
        drawn.emplace(then[i], &before.draws[i]);
    }
    const std::vector<Identity> current = identities(now);
    std::vector<GpuPreviousDraw> draws;
    for (const DrawSource& source : scene.draw_sources()) {
        GpuPreviousDraw& draw = draws.emplace_back();
        const auto found = drawn.find(current[static_cast<size_t>(source.instance)]);
        if (found == drawn.end()) {
            continue;
        }
        const glm::dmat4 m = scene.render_from_vertices(*found->second, source.primitive);
        for (int row = 0; row < 3; ++row) {
            draw.render_from_model[row] = glm::vec4(glm::dvec4(m[0][row], m[1][row], m[2][row], m[3][row]));
        }
        draw.ids.x = 1;
    }
    draws_ = gl::Buffer::of("previous draws", std::span<const GpuPreviousDraw>(draws));
}

void PreviousPose::bind() const {
    draws_.bind_storage(SSBO_PREVIOUS_DRAWS);
    positions_.bind_storage(SSBO_PREVIOUS_POSITIONS);
}

}  // namespace bounce::gpu
