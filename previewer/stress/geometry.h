// SPDX-License-Identifier: Apache-2.0
//
// Triangles of the generated scenes. Metres, Y up.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace bounce::stress {

// Normals are one a vertex, or none: flat then, as the loader makes them.
struct Geometry {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<uint32_t> indices;

    void add(const Geometry& other);
    void add_triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);
    // The same triangles seen from their other side.
    [[nodiscard]] Geometry turned_inside_out() const;
    // Positions as the matrix moves them; without normals.
    [[nodiscard]] Geometry moved(const glm::dmat4& matrix) const;
};

// A square on the ground, facing up, of cells x cells squares of two triangles.
[[nodiscard]] Geometry ground(float size, int cells = 1, float height = 0.0F);
// A box's faces, outwards.
[[nodiscard]] Geometry box(const glm::vec3& low, const glm::vec3& high);
[[nodiscard]] Geometry ball(const glm::vec3& center, float radius, int segments);

}  // namespace bounce::stress
