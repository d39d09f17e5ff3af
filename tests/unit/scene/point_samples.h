// SPDX-License-Identifier: Apache-2.0
//
// What the tests of point sets share: corners and areas of the triangles that points lie on, and a scene of
// shapes of many sizes.
#pragma once

#include <array>
#include <vector>

#include "made_scenes.h"
#include "scene/points/point_set.h"

namespace bounce::scene::test {

inline const Primitive& primitive_of(const Scene& scene, const SurfaceParts& parts, uint32_t surface) {
    const PointSurface& s = parts.surfaces[surface];
    return scene.meshes[static_cast<size_t>(s.mesh)].primitives[static_cast<size_t>(s.primitive)];
}

inline std::array<glm::dvec3, 3> corners(const Scene& scene, const SurfaceParts& parts, uint32_t surface,
                                         const glm::uvec3& triangle) {
    const Primitive& p = primitive_of(scene, parts, surface);
    const Pose pose = evaluate_pose(scene, 0.0);
    const PointSurface& s = parts.surfaces[surface];
    const Node& node = scene.nodes[static_cast<size_t>(s.node)];
    glm::dmat4 m = pose.world_from_node[static_cast<size_t>(s.node)];
    m = node.instances.empty() ? m : m * node.instances[static_cast<size_t>(s.instance)];
    std::array<glm::dvec3, 3> out;
    for (int k = 0; k < 3; ++k) {
        out[static_cast<size_t>(k)] = glm::dvec3(m * glm::dvec4(glm::dvec3(p.positions[triangle[k]]), 1.0));
    }
    return out;
}

inline std::vector<glm::uvec3> triangles_of(const Primitive& p) {
    std::vector<glm::uvec3> out;
    for (size_t i = 0; i + 2 < p.indices.size(); i += 3) {
        out.emplace_back(p.indices[i], p.indices[i + 1], p.indices[i + 2]);
    }
    return out;
}

// For maps.
inline std::array<uint32_t, 4> key(uint32_t surface, const glm::uvec3& triangle) {
    return {surface, triangle.x, triangle.y, triangle.z};
}

inline double area_of(const std::array<glm::dvec3, 3>& c) {
    return 0.5 * glm::length(glm::cross(c[1] - c[0], c[2] - c[0]));
}

inline PointCounts occluders(size_t count, size_t a_map, bool large) {
    PointCounts counts;
    counts.points_a_map = a_map;
    counts.occluders = count;
    counts.large_triangles = large;
    return counts;
}

inline std::vector<bool> none_on_hull(const SurfaceParts& parts) {
    return std::vector<bool>(parts.parts.size(), false);
}

// One right-angled triangle with legs of 1 m.
inline Scene triangle_scene() {
    Scene scene;
    Primitive triangle;
    triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    triangle.indices = {0, 1, 2};
    place_mesh(scene, add_mesh(scene, triangle));
    return scene;
}

// Shapes of many sizes: soup, a box in two places and two scales, a floor.
inline Scene mixed_scene() {
    Scene scene;
    place_mesh(scene, add_mesh(scene, triangle_soup(60, 9)));
    const int crate = add_mesh(scene, box({0.5F, 0.3F, 0.2F}));
    place_mesh(scene, crate, turned(0.5));
    place_mesh(scene, crate, moved({2.0, 0.0, 0.0}) * scaled({1.0, 3.0, 0.5}));
    const int floor = place_mesh(scene, add_mesh(scene, square(3.0F)), moved({0.0, 0.0, -1.5}));
    scene.nodes[static_cast<size_t>(floor)].instances = {glm::dmat4(1.0), moved({3.0, 0.0, 0.0})};
    return scene;
}

}  // namespace bounce::scene::test
