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
    bool on_hull = false;
};

// What stands for the scene's surfaces where visibility is asked for.
//
// Points are spread in proportion to area (Ritschel et al. 2008, "Imperfect Shadow Maps for Efficient
// Computation of Indirect Illumination", 3.1). Within a sequence every run of consecutive points is
// stratified over the whole of its surfaces, the better the nearer its length is to a power of two.
struct PointSet {
    // Occluders that would have many points in every map: drawn as they are. Those on the hull stand last.
    std::vector<SurfaceTriangle> large;
    std::vector<PointSample> occluders;   // on the other surfaces that may hide something, by their covers
    std::vector<PointSample> reflectors;  // on all surfaces, by the primitives' own triangles
    double occluder_area_m2 = 0.0;        // that the points stand for
    double reflector_area_m2 = 0.0;
    // Where reflectors are thinned: the area that one of them stands for where they are dense. 0 where all
    // stand for the same.
    double dense_reflector_area_m2 = 0.0;
};

// Surfaces on which reflectors are drawn the more thinly the farther they lie from a place that light is to
// reach: a surface at a distance d from a ball of radius r sends at most a part (r / d)^2 of its light there,
// and one that lies in a plane through the ball (r / d)^3 in the order of magnitude. In world space.
struct Thinning {
    std::vector<bool> surfaces;  // one a surface
    glm::dvec3 center{0.0};      // of the ball
    double radius = 0.0;
    std::vector<glm::dmat4> world_from_model;  // one a surface; rigid ones alone are thinned
    const Scene* scene = nullptr;              // whose vertices the triangles' corners are
};

struct PointCounts {
    size_t points_a_map = 0;      // of the occluders that each map takes
    size_t occluders = 0;         // in all
    size_t reflectors_a_map = 0;  // in each run of so many they are sorted along a curve over all surfaces
    size_t reflectors = 0;        // in all
    bool large_triangles = true;
    bool hull_hides = false;  // from what is outside of the scene, such as its world
    friend bool operator==(const PointCounts&, const PointCounts&) = default;
};

// Large triangles in one set at most: each costs a test at every texel of every map.
constexpr size_t k_most_large_triangles = 64;

// on_hull: one entry a part (HullFinder): those hide nothing within the scene. thinning: of the reflectors,
// or none. The same input gives the same points.
[[nodiscard]] PointSet sample_points(const SurfaceParts& parts, const std::vector<bool>& on_hull,
                                     const PointCounts& counts, const Thinning* thinning = nullptr);

}  // namespace bounce::scene
