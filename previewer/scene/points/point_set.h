// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "scene/points/surface_parts.h"

namespace bounce::scene {

// A place on a surface that moves with its triangle.
struct PointSample {
    uint32_t surface = 0;     // into SurfaceParts::surfaces
    glm::uvec3 triangle{0U};  // its corners: vertices of the primitive
    float second = 0.0F;      // barycentric weights of the triangle's second and third corner
    float third = 0.0F;
    float share =
        0.0F;           // of its triangle's area, that the point stands for within its sequence; may exceed 1
    bool flat = false;  // on a large plane: a disk there lies in the surface
};

struct SurfaceTriangle {
    uint32_t surface = 0;
    glm::uvec3 triangle{0U};  // as above
};

// What stands for the scene's surfaces where visibility is asked for.
//
// Points are spread in proportion to area (Ritschel et al. 2008, "Imperfect Shadow Maps for Efficient
// Computation of Indirect Illumination", 3.1). Within a sequence every run of consecutive points is
// stratified over the whole of its surfaces, the better the nearer its length is to a power of two.
struct PointSet {
    std::vector<SurfaceTriangle>
        large;  // occluders that would have many points in every map: drawn as they are
    std::vector<PointSample> occluders;   // on the other surfaces that may hide something, by their covers
    std::vector<PointSample> reflectors;  // on all surfaces, by the primitives' own triangles
    double occluder_area_m2 = 0.0;        // that the points stand for
    double reflector_area_m2 = 0.0;
};

struct PointCounts {
    size_t points_a_map = 0;      // of the occluders that each map takes
    size_t occluders = 0;         // in all
    size_t reflectors_a_map = 0;  // in each run of so many they are sorted along a curve over all surfaces
    size_t reflectors = 0;        // in all
    bool large_triangles = true;
    friend bool operator==(const PointCounts&, const PointCounts&) = default;
};

// Large triangles in one set at most: each costs a test at every texel of every map.
constexpr size_t k_most_large_triangles = 64;

// on_hull: one entry a part (HullFinder): those hide nothing. The same input gives the same points.
[[nodiscard]] PointSet sample_points(const SurfaceParts& parts, const std::vector<bool>& on_hull,
                                     const PointCounts& counts);

}  // namespace bounce::scene
