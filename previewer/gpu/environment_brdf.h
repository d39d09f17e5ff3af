// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace bounce::gpu {

// What a GGX lobe reflects of an even world: x of its reflectance at normal incidence, y of that's rise to
// grazing, by the law of shaders/lib/brdf.glsl for an index of refraction of 1.5 (independent Smith
// shadowing, single scattering). n_dot_v: cosine between normal and viewer.
[[nodiscard]] glm::dvec2 environment_brdf(double n_dot_v, double roughness);

// For size x size cosines (columns) and roughnesses (rows), from 0 to 1: the two above, and how to find the
// lobe among those seen head on by its first moment: z, radians from the mirrored view towards the normal of
// its mean direction; w, the roughness of the lobe seen head on whose mean direction is as long.
[[nodiscard]] std::vector<glm::vec4> environment_brdf_table(int size);

}  // namespace bounce::gpu
