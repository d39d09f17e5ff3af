// SPDX-License-Identifier: Apache-2.0
//
// Directions and solid angles of an equirectangular image, as Cycles lays it out.
#pragma once

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace bounce::scene {

// The unit vector, in the image's own axes (glTF's: Y up), that a place of the image is seen along. u: 0 at
// its left edge, 1 at its right; v: 0 at its top, 1 at its bottom.
[[nodiscard]] glm::dvec3 environment_direction(double u, double v);

// Solid angle of one texel of row y of an image of width x height texels; all together are 4 pi.
[[nodiscard]] double environment_texel_sr(int width, int height, int y);

// Radiance that the whole sphere sends on average.
[[nodiscard]] glm::vec3 mean_radiance(const Environment& environment);

}  // namespace bounce::scene
