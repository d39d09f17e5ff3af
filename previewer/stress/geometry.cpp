// SPDX-License-Identifier: Apache-2.0
#include "stress/geometry.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace bounce::stress {

void Geometry::add(const Geometry& other) {
    const auto first = static_cast<uint32_t>(positions.size());
    positions.insert(positions.end(), other.positions.begin(), other.positions.end());
    normals.insert(normals.end(), other.normals.begin(), other.normals.end());
    for (const uint32_t index : other.indices) {
        indices.push_back(first + index);
    }
}

void Geometry::add_triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    for (const glm::vec3& corner : {a, b, c}) {
        indices.push_back(static_cast<uint32_t>(positions.size()));
        positions.push_back(corner);
    }
}

Geometry Geometry::turned_inside_out() const {
    Geometry out = *this;
    for (size_t i = 0; i + 2 < out.indices.size(); i += 3) {
        std::swap(out.indices[i + 1], out.indices[i + 2]);
    }
    for (glm::vec3& normal : out.normals) {
        normal = -normal;
    }
    return out;
}

Geometry Geometry::moved(const glm::dmat4& matrix) const {
    Geometry out = *this;
    out.normals.clear();
    for (glm::vec3& position : out.positions) {
        position = glm::vec3(matrix * glm::dvec4(glm::dvec3(position), 1.0));
    }
    return out;
}

Geometry ground(float size, int cells, float height) {
    Geometry out;
    for (int z = 0; z <= cells; ++z) {
        for (int x = 0; x <= cells; ++x) {
            out.positions.emplace_back(size * (static_cast<float>(x) / static_cast<float>(cells) - 0.5F),
                                       height,
                                       size * (static_cast<float>(z) / static_cast<float>(cells) - 0.5F));
        }
    }
    out.normals.assign(out.positions.size(), {0.0F, 1.0F, 0.0F});
    const auto row = static_cast<uint32_t>(cells + 1);
    for (uint32_t z = 0; z + 1 < row; ++z) {
        for (uint32_t x = 0; x + 1 < row; ++x) {
            const uint32_t at = z * row + x;
            out.indices.insert(out.indices.end(), {at, at + row, at + row + 1, at, at + row + 1, at + 1});
        }
    }
    return out;
}

Geometry box(const glm::vec3& low, const glm::vec3& high) {
    Geometry out;
    const glm::vec3 size = high - low;
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 u(0.0F);
        glm::vec3 v(0.0F);
        u[(axis + 1) % 3] = size[(axis + 1) % 3];
        v[(axis + 2) % 3] = size[(axis + 2) % 3];
        for (const bool upper : {false, true}) {
            const auto first = static_cast<uint32_t>(out.positions.size());
            glm::vec3 corner = low;
            corner[axis] = upper ? high[axis] : low[axis];
            glm::vec3 normal(0.0F);
            normal[axis] = upper ? 1.0F : -1.0F;
            const glm::vec3& first_side = upper ? u : v;
            const glm::vec3& second_side = upper ? v : u;
            for (const glm::vec3& p : {corner, corner + first_side, corner + u + v, corner + second_side}) {
                out.positions.push_back(p);
                out.normals.push_back(normal);
            }
            for (const uint32_t index : {0U, 1U, 2U, 0U, 2U, 3U}) {
                out.indices.push_back(first + index);
            }
        }
    }
    return out;
}

Geometry ball(const glm::vec3& center, float radius, int segments) {
    Geometry out;
    const int rings = segments / 2;
    for (int ring = 0; ring <= rings; ++ring) {
        const double theta = std::numbers::pi * ring / rings;
        for (int segment = 0; segment <= segments; ++segment) {
            const double phi = 2.0 * std::numbers::pi * segment / segments;
            const glm::vec3 normal(glm::dvec3(std::sin(theta) * std::cos(phi), std::cos(theta),
                                              -std::sin(theta) * std::sin(phi)));
            out.positions.push_back(center + radius * normal);
            out.normals.push_back(normal);
        }
    }
    for (int ring = 0; ring < rings; ++ring) {
        for (int segment = 0; segment < segments; ++segment) {
            const auto upper = static_cast<uint32_t>(ring * (segments + 1) + segment);
            const auto lower = static_cast<uint32_t>(upper + static_cast<uint32_t>(segments) + 1);
            out.indices.insert(out.indices.end(), {upper, lower, lower + 1, upper, lower + 1, upper + 1});
        }
    }
    return out;
}

}  // namespace bounce::stress
