// SPDX-License-Identifier: Apache-2.0
//
// Scenes made of numbers, for what works on surfaces.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "scene/points/surface_parts.h"
#include "scene/pose.h"
#include "scene/scene.h"

namespace bounce::scene::test {

inline constexpr double pi = std::numbers::pi;

inline int add_node(Scene& scene, Node node) {
    scene.nodes.push_back(std::move(node));
    const int index = static_cast<int>(scene.nodes.size()) - 1;
    scene.topological_order.push_back(index);
    if (scene.nodes.back().parent == k_none) {
        scene.roots.push_back(index);
    }
    return index;
}

inline int add_mesh(Scene& scene, Primitive primitive) {
    if (primitive.normals.empty()) {
        primitive.normals.assign(primitive.positions.size(), {0.0F, 0.0F, 1.0F});
    }
    scene.meshes.push_back({"mesh", {std::move(primitive)}, {}});
    return static_cast<int>(scene.meshes.size()) - 1;
}

inline int place_mesh(Scene& scene, int mesh, const glm::dmat4& matrix = glm::dmat4(1.0)) {
    Node node;
    node.mesh = mesh;
    node.matrix = matrix;
    return add_node(scene, node);
}

// A square of side `size` in the XY plane, of two triangles.
inline Primitive square(float size) {
    const float h = 0.5F * size;
    Primitive p;
    p.positions = {{-h, -h, 0.0F}, {h, -h, 0.0F}, {h, h, 0.0F}, {-h, h, 0.0F}};
    p.indices = {0, 1, 2, 0, 2, 3};
    return p;
}

// A box from -half to half, twelve triangles facing outwards.
inline Primitive box(const glm::vec3& half) {
    Primitive p;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0F, 1.0F}) {
            const auto first = static_cast<uint32_t>(p.positions.size());
            const int u = (axis + 1) % 3;
            const int v = (axis + 2) % 3;
            for (const auto& corner :
                 std::array<std::array<float, 2>, 4>{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}) {
                glm::vec3 position(0.0F);
                position[axis] = side;
                position[u] = corner[0] * side;
                position[v] = corner[1];
                p.positions.push_back(position * half);
            }
            for (const uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) {
                p.indices.push_back(first + i);
            }
        }
    }
    return p;
}

// Triangles of many sizes in all directions: none of them flat enough to count as a plane with another.
inline Primitive triangle_soup(int triangles, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> in(-1.0F, 1.0F);
    Primitive p;
    for (int i = 0; i < triangles; ++i) {
        const glm::vec3 center(in(random), in(random), in(random));
        const float size = 0.02F + 0.3F * std::abs(in(random));
        for (int k = 0; k < 3; ++k) {
            p.positions.push_back(center + size * glm::vec3(in(random), in(random), in(random)));
            p.indices.push_back(static_cast<uint32_t>(p.indices.size()));
        }
    }
    return p;
}

// Area of a primitive under a transform, corner by corner.
inline double area_under(const Primitive& p, const glm::dmat4& m) {
    double sum = 0.0;
    for (size_t i = 0; i + 2 < p.indices.size(); i += 3) {
        std::array<glm::dvec3, 3> c;
        for (size_t k = 0; k < 3; ++k) {
            c[k] = glm::dvec3(m * glm::dvec4(glm::dvec3(p.positions[p.indices[i + k]]), 1.0));
        }
        sum += 0.5 * glm::length(glm::cross(c[1] - c[0], c[2] - c[0]));
    }
    return sum;
}

inline glm::dmat4 moved(const glm::dvec3& by) {
    return glm::translate(glm::dmat4(1.0), by);
}

inline glm::dmat4 scaled(const glm::dvec3& by) {
    return glm::scale(glm::dmat4(1.0), by);
}

// Turned about an axis of no particular direction.
inline glm::dmat4 turned(double angle_rad) {
    return glm::rotate(glm::dmat4(1.0), angle_rad, glm::normalize(glm::dvec3(1.0, 2.0, -0.5)));
}

}  // namespace bounce::scene::test
