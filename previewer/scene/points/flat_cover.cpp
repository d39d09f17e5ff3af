// SPDX-License-Identifier: Apache-2.0
#include "scene/points/flat_cover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include <GL/glu.h>

#include "scene/points/outline.h"

namespace bounce::scene {
namespace {

// Of the piece's size: straight edges and planes stray by that in float positions, also at some distance from
// the origin.
constexpr double k_tolerance = 1e-5;

// How far the cover's area may be off the triangles', of itself.
constexpr double k_area_tolerance = 1e-4;

// The vertices that triangles have, each place once, with the plane they lie in as the plane of x and y.
struct Flat {
    std::vector<uint32_t> vertices;     // of each place
    std::vector<glm::dvec2> places;     // parallel; the middle is near the origin
    std::vector<glm::uvec3> triangles;  // into these
    double size = 0.0;
    double off_plane = 0.0;  // the farthest place
};

double doubled_area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Of no height to speak of: corners that nearly stand in line.
bool is_sliver(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, double tolerance) {
    const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
    return std::abs(doubled_area(a, b, c)) <= tolerance * longest;
}

double sum_of_areas(const std::vector<glm::dvec2>& places, const std::vector<glm::uvec3>& triangles) {
    double sum = 0.0;
    for (const glm::uvec3& t : triangles) {
        sum += 0.5 * std::abs(doubled_area(places[t.x], places[t.y], places[t.z]));
    }
    return sum;
}

// Vertices that stand in one place (of a hard edge or a seam) become one; `vertices` receives one of each
// place.
std::vector<glm::uvec3> weld(const std::vector<glm::dvec3>& positions,
                             const std::vector<glm::uvec3>& triangles, std::vector<uint32_t>& vertices) {
    // By their numbers less the lowest: those of a piece mostly stand together.
    uint32_t low = triangles[0].x;
    uint32_t high = low;
    for (const glm::uvec3& t : triangles) {
        low = std::min({low, t.x, t.y, t.z});
        high = std::max({high, t.x, t.y, t.z});
    }
    constexpr uint32_t unused = 0xFFFFFFFFU;
    std::vector<uint32_t> place_of(size_t{high} - low + 1, unused);
    std::vector<std::pair<std::array<double, 3>, uint32_t>> used;
    for (const glm::uvec3& t : triangles) {
        for (int k = 0; k < 3; ++k) {
            if (uint32_t& place = place_of[t[k] - low]; place == unused) {
                const glm::dvec3& p = positions[t[k]];
                used.push_back({{p.x, p.y, p.z}, t[k]});
                place = 0;
            }
        }
    }
    std::sort(used.begin(), used.end());
    for (size_t i = 0; i < used.size(); ++i) {
        if (i == 0 || used[i].first != used[i - 1].first) {
            vertices.push_back(used[i].second);
        }
        place_of[used[i].second - low] = static_cast<uint32_t>(vertices.size() - 1);
    }
    std::vector<glm::uvec3> out;
    out.reserve(triangles.size());
    for (const glm::uvec3& t : triangles) {
        out.emplace_back(place_of[t.x - low], place_of[t.y - low], place_of[t.z - low]);
    }
    return out;
}

Flat lay_flat(const std::vector<glm::dvec3>& positions, const std::vector<glm::uvec3>& triangles) {
    Flat flat;
    flat.triangles = weld(positions, triangles, flat.vertices);
    glm::dvec3 across(0.0);
    for (const glm::uvec3& t : triangles) {
        across += glm::cross(positions[t.y] - positions[t.x], positions[t.z] - positions[t.x]);
    }
    const glm::dvec3 normal = glm::normalize(across);
    glm::dvec3 middle(0.0);
    for (const uint32_t vertex : flat.vertices) {
        middle += positions[vertex] / static_cast<double>(flat.vertices.size());
    }
    const glm::dvec3 any = std::abs(normal.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 x = glm::normalize(glm::cross(any, normal));
    const glm::dvec3 y = glm::cross(normal, x);
    for (const uint32_t vertex : flat.vertices) {
        const glm::dvec3 from_middle = positions[vertex] - middle;
        flat.places.emplace_back(glm::dot(from_middle, x), glm::dot(from_middle, y));
        flat.size = std::max(flat.size, 2.0 * glm::length(from_middle));
        flat.off_plane = std::max(flat.off_plane, std::abs(glm::dot(from_middle, normal)));
    }
    return flat;
}

// Triangles inside of outlines, by the tessellator of the OpenGL utility library: a sweep that bears outlines
// which touch or cross.
class Tessellator {
  public:
    Tessellator(const Flat& flat, double tolerance) : flat_(flat), tolerance_(tolerance) {}

    // False where it could not be done with the vertices there are.
    bool fill(const std::vector<Outline>& outlines, std::vector<glm::uvec3>& triangles) {
        const std::unique_ptr<GLUtesselator, decltype(&gluDeleteTess)> tess(gluNewTess(), &gluDeleteTess);
        if (!tess) {
            return false;
        }
        using Callback = void (*)();
        gluTessCallback(tess.get(), GLU_TESS_VERTEX_DATA, reinterpret_cast<Callback>(&add_vertex));
        gluTessCallback(tess.get(), GLU_TESS_COMBINE_DATA, reinterpret_cast<Callback>(&combine));
        gluTessCallback(tess.get(), GLU_TESS_ERROR_DATA, reinterpret_cast<Callback>(&fail));
        // Asked for edge flags, it makes no fans and strips.
        gluTessCallback(tess.get(), GLU_TESS_EDGE_FLAG, reinterpret_cast<Callback>(&ignore_edge_flag));
        gluTessProperty(tess.get(), GLU_TESS_WINDING_RULE, GLU_TESS_WINDING_POSITIVE);
        gluTessNormal(tess.get(), 0.0, 0.0, 1.0);
        size_t count = 0;
        for (const Outline& outline : outlines) {
            count += outline.size();
        }
        corners_.reserve(count);  // their addresses are given away
        gluTessBeginPolygon(tess.get(), this);
        for (const Outline& outline : outlines) {
            gluTessBeginContour(tess.get());
            for (const uint32_t place : outline) {
                const glm::dvec2& p = flat_.places[place];
                Corner& corner = corners_.emplace_back(Corner{{p.x, p.y, 0.0}, place});
                gluTessVertex(tess.get(), corner.coordinates.data(), &corner);
            }
            gluTessEndContour(tess.get());
        }
        gluTessEndPolygon(tess.get());
        for (size_t i = 0; i + 2 < found_.size(); i += 3) {
            triangles.emplace_back(found_[i], found_[i + 1], found_[i + 2]);
        }
        return !failed_;
    }

  private:
    struct Corner {
        std::array<GLdouble, 3> coordinates;
        uint32_t place;
    };

    static void GLAPIENTRY add_vertex(void* vertex, void* self) {
        static_cast<Tessellator*>(self)->found_.push_back(static_cast<const Corner*>(vertex)->place);
    }

    // Where outlines meet: at a corner that is there already, or else these are no outlines of one plane.
    static void GLAPIENTRY combine(const GLdouble coordinates[3], void* vertices[4],
                                   const GLfloat /*weights*/[4], void** out, void* self) {
        auto* me = static_cast<Tessellator*>(self);
        const glm::dvec2 at(coordinates[0], coordinates[1]);
        double nearest = 2.0 * me->tolerance_;
        *out = nullptr;
        for (int i = 0; i < 4; ++i) {
            const auto* corner = static_cast<const Corner*>(vertices[i]);
            if (corner == nullptr) {
                continue;
            }
            const double distance = glm::distance(at, me->flat_.places[corner->place]);
            if (distance <= nearest) {
                nearest = distance;
                *out = vertices[i];
            }
        }
        if (*out == nullptr) {
            me->failed_ = true;
            *out = vertices[0];
        }
    }

    static void GLAPIENTRY fail(GLenum /*error*/, void* self) {
        static_cast<Tessellator*>(self)->failed_ = true;
    }

    static void GLAPIENTRY ignore_edge_flag(GLboolean /*flag*/) {}

    const Flat& flat_;
    double tolerance_;
    std::vector<Corner> corners_;
    std::vector<uint32_t> found_;
    bool failed_ = false;
};

// Without those of which nothing is left.
std::vector<Outline> straighten_all(const std::vector<Outline>& outlines,
                                    const std::vector<glm::dvec2>& places, double tolerance) {
    std::vector<Outline> out;
    for (const Outline& outline : outlines) {
        if (Outline straight = straighten(outline, places, tolerance); !straight.empty()) {
            out.push_back(std::move(straight));
        }
    }
    return out;
}

// Whether the triangles face up and have the area: with outlines that are the same, they cover the same.
bool covers(const Flat& flat, const std::vector<glm::uvec3>& cover) {
    const bool face_up = std::all_of(cover.begin(), cover.end(), [&](const glm::uvec3& t) {
        return doubled_area(flat.places[t.x], flat.places[t.y], flat.places[t.z]) > 0.0;
    });
    const double area = sum_of_areas(flat.places, flat.triangles);
    return face_up && std::abs(sum_of_areas(flat.places, cover) - area) <= k_area_tolerance * area;
}

}  // namespace

std::vector<glm::uvec3> flat_cover(const std::vector<glm::dvec3>& positions,
                                   const std::vector<glm::uvec3>& triangles) {
    if (triangles.size() < 2) {
        return {};
    }
    const Flat flat = lay_flat(positions, triangles);
    const double tolerance = k_tolerance * flat.size;
    if (!(flat.off_plane <= tolerance)) {
        return {};
    }
    // Once more, because neighbours whose vertices differ along the edge between them share it when both are
    // straight.
    std::vector<Outline> outlines = straighten_all(find_outlines(flat.triangles), flat.places, tolerance);
    outlines = straighten_all(join_outlines(outlines), flat.places, tolerance);
    size_t corners = 0;
    for (const Outline& outline : outlines) {
        corners += outline.size();
    }
    // An outline of n corners takes n - 2 triangles at least.
    if (corners > k_most_cover_corners || corners >= triangles.size() + 2 * outlines.size()) {
        return {};
    }
    std::vector<glm::uvec3> cover;
    if (!Tessellator(flat, tolerance).fill(outlines, cover)) {
        return {};
    }
    std::erase_if(cover, [&](const glm::uvec3& t) {
        return is_sliver(flat.places[t.x], flat.places[t.y], flat.places[t.z], tolerance);
    });
    if (cover.empty() || cover.size() >= triangles.size() || !covers(flat, cover)) {
        return {};
    }
    for (glm::uvec3& t : cover) {
        t = {flat.vertices[t.x], flat.vertices[t.y], flat.vertices[t.z]};
    }
    return cover;
}

}  // namespace bounce::scene
