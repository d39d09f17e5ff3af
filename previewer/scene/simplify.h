// SPDX-License-Identifier: Apache-2.0
//
// Fewer triangles for about the same surface, by quadric error (Garland and Heckbert 1997, "Surface
// Simplification Using Quadric Error Metrics"), as meshoptimizer has it. Triangles of the result have
// vertices of the primitive, so that skins and morph targets move them as they move the primitive.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace bounce::scene {

struct Simplification {
    double ratio = 0.0;    // of the triangles to keep, above 0 to 1; 0: so many that simplified_ratio() says
    double error = 0.005;  // largest distance that the surface may move, as a part of the primitive's extent
    friend bool operator==(const Simplification&, const Simplification&) = default;
};

struct SimplifiedPrimitive {
    std::vector<uint32_t> indices;  // three a triangle, into the primitive's vertices
    double error_model = 0.0;       // how far the surface moved, model units; 0 where it did not
};

// Per mesh and primitive.
using SimplifiedMeshes = std::vector<std::vector<SimplifiedPrimitive>>;

// A scene of about several thousand triangles, as Lv et al. 2009 simplify theirs to ("A Fast Method for
// Real-time Computation of Approximated Global Illumination", section III.C): 3,400 and 8,900 in its Table I.
inline constexpr size_t k_simplified_triangles = 6000;

// The share of so many drawn triangles that leaves k_simplified_triangles; 1 where there are fewer.
[[nodiscard]] double simplified_ratio(size_t drawn_triangles);

// lock_border: open edges stay where they are. Never more triangles than before. A ratio of 1 changes
// nothing, and the primitive is left as it is where it has few triangles already, such as a box, and where
// what is left of it would not be its surface any more.
[[nodiscard]] SimplifiedPrimitive simplify(const Primitive& primitive, double ratio, double error,
                                           bool lock_border);

// Every primitive. Cut-outs keep their triangles, because their outline is in their texture; borders are
// locked where a mesh has several primitives, which meet there.
[[nodiscard]] SimplifiedMeshes simplify_scene(const Scene& scene, const Simplification& settings);

}  // namespace bounce::scene
