// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "gpu/render_space.h"
#include "scene/pose.h"

namespace bounce::gpu {

// Render space; around all that a draw draws.
struct DrawBox {
    glm::vec3 low{1.0F};
    glm::vec3 high{-1.0F};
    // Of a box whose extent is not known.
    [[nodiscard]] bool unknown() const { return !(low.x <= high.x); }
};

// world: empty where the extent is not known.
[[nodiscard]] DrawBox draw_box(const scene::Bounds& world, const RenderSpace& space);

// False where nothing in the box falls into the picture of a projection, which has no near and no far plane
// (as with GL_DEPTH_CLAMP). Conservative: true where rounding could tell otherwise, and of a box that is not
// known.
[[nodiscard]] bool may_be_seen(const DrawBox& box, const glm::mat4& clip_from_render);

}  // namespace bounce::gpu
