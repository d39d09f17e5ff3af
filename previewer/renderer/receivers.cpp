// SPDX-License-Identifier: Apache-2.0
#include "renderer/receivers.h"

#include <array>

namespace bounce {
namespace {

using Polygon = std::vector<glm::dvec3>;

double height(const glm::dvec4& plane, const glm::dvec3& p) {
    return glm::dot(glm::dvec3(plane), p) + plane.w;
}

glm::dvec3 crossing(const glm::dvec3& a, const glm::dvec3& b, double height_a, double height_b) {
    return a + (b - a) * (height_a / (height_a - height_b));
}

// Sutherland and Hodgman 1974, "Reentrant Polygon Clipping".
Polygon clip_polygon(const Polygon& polygon, const glm::dvec4& plane) {
    Polygon out;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3& a = polygon[i];
        const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
        const double height_a = height(plane, a);
        const double height_b = height(plane, b);
        if (height_a >= 0.0) {
            out.push_back(a);
        }
        if ((height_a >= 0.0) != (height_b >= 0.0)) {
            out.push_back(crossing(a, b, height_a, height_b));
        }
    }
    return out;
}

std::array<Polygon, 6> faces(const gpu::DrawBox& box) {
    const glm::dvec3 ends[2] = {glm::dvec3(box.low), glm::dvec3(box.high)};
    std::array<Polygon, 6> out;
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2;
        for (const auto& [s, t] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
            glm::dvec3 p;
            p[axis] = ends[face % 2][axis];
            p[(axis + 1) % 3] = ends[s][(axis + 1) % 3];
            p[(axis + 2) % 3] = ends[t][(axis + 2) % 3];
            out[static_cast<size_t>(face)].push_back(p);
        }
    }
    return out;
}

// The picture's four sides and its near plane: clip depth is 1 there and less beyond.
std::array<glm::dvec4, 5> planes_of(const glm::dmat4& clip_from_render) {
    const glm::dmat4 rows = glm::transpose(clip_from_render);
    return {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1], rows[3] - rows[2]};
}

bool holds(const gpu::DrawBox& box, const glm::dvec3& p) {
    return glm::all(glm::greaterThanEqual(p, glm::dvec3(box.low))) &&
           glm::all(glm::lessThanEqual(p, glm::dvec3(box.high)));
}

}  // namespace

std::vector<Region> seen_regions(const std::vector<gpu::DrawBox>& boxes, const gpu::DrawBox& all,
                                 const glm::dmat4& clip_from_render, const glm::dmat4& render_from_clip) {
    const std::array<glm::dvec4, 5> planes = planes_of(clip_from_render);
    std::array<glm::dvec3, 4> near_corners;
    for (size_t i = 0; i < near_corners.size(); ++i) {
        const glm::dvec4 p =
            render_from_clip * glm::dvec4(i % 2 == 0 ? -1.0 : 1.0, i < 2 ? -1.0 : 1.0, 1.0, 1.0);
        near_corners[i] = glm::dvec3(p) / p.w;
    }
    std::vector<Region> out;
    for (const gpu::DrawBox& given : boxes) {
        const gpu::DrawBox& box = given.unknown() ? all : given;
        Region region;
        for (Polygon polygon : faces(box)) {
            for (const glm::dvec4& plane : planes) {
                polygon = clip_polygon(polygon, plane);
            }
            region.insert(region.end(), polygon.begin(), polygon.end());
        }
        // Of the picture's own corners those of the near plane alone can lie inside the box and on none of
        // its sides.
        for (const glm::dvec3& corner : near_corners) {
            if (holds(box, corner)) {
                region.push_back(corner);
            }
        }
        if (!region.empty()) {
            out.push_back(std::move(region));
        }
    }
    return out;
}

Region clipped(const Region& region, const glm::dvec4& plane) {
    Region out;
    Region beyond;
    for (const glm::dvec3& p : region) {
        (height(plane, p) >= 0.0 ? out : beyond).push_back(p);
    }
    const size_t kept = out.size();
    for (size_t i = 0; i < kept; ++i) {
        for (const glm::dvec3& b : beyond) {
            out.push_back(crossing(out[i], b, height(plane, out[i]), height(plane, b)));
        }
    }
    return out;
}

}  // namespace bounce
