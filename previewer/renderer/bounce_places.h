// SPDX-License-Identifier: Apache-2.0
//
// Places on a large area light that its bounced light starts from: a reflective shadow map is of a point, and
// one of the light's middle lights too little too brightly. Arithmetic without OpenGL.
#pragma once

#include <vector>

#include "renderer/light_setup.h"
#include "scene/pose.h"

namespace bounce {

// Of the scene's diagonal: an area light whose own diagonal is at least this long has places. docs/lights.md
// has the measurement ("Bounced light of area lights").
inline constexpr double k_large_light = 0.4;

// How many places an instance's bounced light starts from: `most` (a power of two, 1 to 16) for a large area
// light and for one that shines with an image, otherwise 1. scene_diagonal_m: of the whole animation, or
// lights would change their places with what moves; 0: nothing is large.
[[nodiscard]] int count_bounce_places(const scene::LightInstance& instance, const scene::Light& light,
                                      double scene_diagonal_m, int most);

// An area light as `count` lights of even power, each seen from its place and named after it; together their
// reflective shadow maps have as many texels as the light's one. 1: the light itself. Places are fixed in the
// light's frame, so that they move with it. pattern: the light's image; each place sends its piece's part of
// it.
[[nodiscard]] std::vector<LightSetup> bounce_places(const LightSetup& light, int count,
                                                    const scene::LightPattern& pattern = {});

}  // namespace bounce
