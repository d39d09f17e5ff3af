// SPDX-License-Identifier: Apache-2.0
//
// Which part of the scene a picture shows, for fitting maps to it. Arithmetic without OpenGL.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "gpu/draw_box.h"

namespace bounce {

// Corners of a convex piece of space, render space.
using Region = std::vector<glm::dvec3>;

// The part of each box that falls into the picture in front of the near plane; boxes out of sight have none.
// A box that is not known stands for `all`. Conservative: the far plane is not looked at.
[[nodiscard]] std::vector<Region> seen_regions(const std::vector<gpu::DrawBox>& boxes,
                                               const gpu::DrawBox& all, const glm::dmat4& clip_from_render,
                                               const glm::dmat4& render_from_clip);

// The part of a region where dot(plane, (p, 1)) >= 0, as the corners that bound it; empty where there is
// none. Between every two corners on either side there is one of the result, which holds more than the edges
// need.
[[nodiscard]] Region clipped(const Region& region, const glm::dvec4& plane);

}  // namespace bounce
