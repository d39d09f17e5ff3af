// SPDX-License-Identifier: Apache-2.0
//
// More triangles for the same surface, to measure what their number costs.
#pragma once

#include <cstddef>

#include "scene/scene.h"

namespace bounce::scene {

// How every triangle is split: along each edge into `segments`, which makes segments^2 similar triangles, of
// which on average `centre_splits` are split in three at their centre. Neither moves the surface, and no
// vertex comes to lie on a neighbour's edge.
struct Refinement {
    int segments = 1;
    double centre_splits = 0.0;
    [[nodiscard]] double factor() const { return segments * segments + 2.0 * centre_splits; }
};

// The refinement that multiplies triangles by the factor (1 or more). Between 3 and 4 by 4, which is the one
// gap that these splits leave.
[[nodiscard]] Refinement refinement_by(double factor);

// The primitive with its triangles split. New vertices take the mean of every stream: directions are made
// unit again, of joint influences the four largest are kept. first_triangle is the number of triangles before
// it in its scene, so that centre splits spread evenly over primitives of few triangles.
[[nodiscard]] Primitive refine(const Primitive& primitive, const Refinement& refinement,
                               size_t first_triangle = 0);

// Splits every primitive.
void refine_scene(Scene& scene, const Refinement& refinement);

}  // namespace bounce::scene
