// SPDX-License-Identifier: Apache-2.0
#include "scene/points/ground.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "scene/primitive_bounds.h"

namespace bounce::scene {
namespace {

size_t at(int index) {
    return static_cast<size_t>(index);
}

// Planes are one where their normals agree to about a third of a degree, and the places of what lies in them
// along the normal to this part of the scene's diagonal.
constexpr double k_same_direction = 1.0 - 2e-5;
constexpr double k_same_place = 1e-3;

// A surface that is one flat part on the hull, in world space.
struct Plane {
    glm::dvec3 normal{0.0};
    double offset = 0.0;
    double area_m2 = 0.0;
};

// Draws by what they draw: a surface knows its node, instance and primitive.
using DrawOf = std::map<std::pair<int, int>, const DrawInstance*>;

DrawOf draws_by_instance(const Pose& pose) {
    DrawOf out;
    std::map<int, int> seen;
    for (const DrawInstance& draw : pose.draws) {
        out[{draw.node, seen[draw.node]++}] = &draw;
    }
    return out;
}

std::optional<Plane> plane_of(const SurfacePart& part, const glm::dmat4& m) {
    const glm::dvec3 x(m[0]);
    const glm::dvec3 y(m[1]);
    const glm::dvec3 z(m[2]);
    const glm::dmat3 cofactor(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
    const glm::dvec3 across = cofactor * part.table->normal;
    const double length = glm::length(across);
    if (!(length > 0.0) || !std::isfinite(length)) {
        return std::nullopt;
    }
    const glm::dvec3 normal = across / length;
    return Plane{normal, glm::dot(normal, glm::dvec3(m * glm::dvec4(part.table->point, 1.0))), part.area_m2};
}

bool same(const Plane& a, const Plane& b, double tolerance) {
    const double cosine = glm::dot(a.normal, b.normal);
    return std::abs(cosine) > k_same_direction &&
           std::abs(a.offset - std::copysign(b.offset, cosine * b.offset)) < tolerance;
}

}  // namespace

Ground find_ground(const Scene& scene, const Pose& pose, const SurfaceParts& parts,
                   const std::vector<bool>& on_hull) {
    const DrawOf draws = draws_by_instance(pose);
    const auto draw_of = [&](const PointSurface& surface) {
        const auto found = draws.find({surface.node, surface.instance});
        return found == draws.end() ? nullptr : found->second;
    };
    std::vector<int> parts_of(parts.surfaces.size(), 0);
    for (const SurfacePart& part : parts.parts) {
        ++parts_of[part.surface];
    }
    std::vector<std::optional<Plane>> planes(parts.surfaces.size());
    const Plane* widest = nullptr;
    for (size_t i = 0; i < parts.parts.size(); ++i) {
        const SurfacePart& part = parts.parts[i];
        const PointSurface& surface = parts.surfaces[part.surface];
        const DrawInstance* draw = draw_of(surface);
        if (draw == nullptr || !on_hull[i] || !part.table->flat || parts_of[part.surface] != 1 ||
            surface.deforms) {
            continue;
        }
        std::optional<Plane>& plane = planes[part.surface];
        plane = plane_of(part, draw->world_from_model);
        if (plane && (widest == nullptr || plane->area_m2 > widest->area_m2)) {
            widest = &*plane;
        }
    }
    const Bounds all = world_bounds(scene, pose);
    Ground out{std::vector<bool>(parts.surfaces.size(), false), {}};
    for (size_t i = 0; i < parts.surfaces.size(); ++i) {
        const PointSurface& surface = parts.surfaces[i];
        const DrawInstance* draw = draw_of(surface);
        out.surfaces[i] =
            widest != nullptr && planes[i] && same(*planes[i], *widest, k_same_place * all.diagonal());
        if (draw != nullptr && !out.surfaces[i]) {
            const Primitive& primitive = scene.meshes[at(surface.mesh)].primitives[at(surface.primitive)];
            grow_by_primitive(out.rest, pose, *draw,
                              primitive.bounds.all.empty() ? primitive_bounds(primitive) : primitive.bounds);
        }
    }
    if (out.rest.empty()) {
        out.surfaces.assign(parts.surfaces.size(), false);
        out.rest = all;
    }
    return out;
}

}  // namespace bounce::scene
