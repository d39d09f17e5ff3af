// SPDX-License-Identifier: Apache-2.0
#include "gpu/draw_box.h"

#include <cmath>

namespace bounce::gpu {
namespace {

// Far more than floats lose on the way through matrices.
constexpr float k_margin = 1e-4F;

}  // namespace

DrawBox draw_box(const scene::Bounds& world, const RenderSpace& space) {
    return world.empty() ? DrawBox{}
                         : DrawBox{glm::vec3(space.point(world.low)), glm::vec3(space.point(world.high))};
}

bool may_be_seen(const DrawBox& box, const glm::mat4& clip_from_render) {
    if (box.unknown()) {
        return true;
    }
    // In homogeneous coordinates each side of the picture is a half-space, for what lies behind the eye as
    // well: a box whose corners all lie beyond one side lies beyond it altogether.
    bool beyond[4] = {true, true, true, true};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec4 p((corner & 1) != 0 ? box.high.x : box.low.x,
                          (corner & 2) != 0 ? box.high.y : box.low.y,
                          (corner & 4) != 0 ? box.high.z : box.low.z, 1.0F);
        const glm::vec4 clip = clip_from_render * p;
        for (int axis = 0; axis < 2; ++axis) {
            const float margin = k_margin * (std::abs(clip[axis]) + std::abs(clip.w) + 1.0F);
            // Written so that what is not a number is not beyond.
            beyond[2 * axis] &= clip[axis] - clip.w > margin;
            beyond[2 * axis + 1] &= -clip[axis] - clip.w > margin;
        }
    }
    return !(beyond[0] || beyond[1] || beyond[2] || beyond[3]);
}

}  // namespace bounce::gpu
