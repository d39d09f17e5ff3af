// SPDX-License-Identifier: Apache-2.0
//
// What places on an area light that shines with an image send, over the light's mean. Arithmetic without
// OpenGL.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace bounce {

// Of each place (x and y, -1 to 1 over the light's own X and Y) the mean of what is nearer to it than to any
// other, so that together they send what the light does: the mean of all is the pattern's over the shape, 1
// in each channel that shines at all. round: the shape is the ellipse in the rectangle. pattern must not be
// empty.
[[nodiscard]] std::vector<glm::vec3> light_tints(const scene::LightPattern& pattern,
                                                 std::span<const glm::dvec2> places, bool round);

}  // namespace bounce
