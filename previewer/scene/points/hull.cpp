// SPDX-License-Identifier: Apache-2.0
#include "scene/points/hull.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "scene/primitive_bounds.h"

namespace bounce::scene {
namespace {

size_t at(int index) {
    return static_cast<size_t>(index);
}

// What may lie beyond a hull part's plane, of the scene's diagonal: feet that sink into a floor a little.
// Light between places that deep is taken for unhidden.
constexpr double k_tolerance = 1e-3;

// Directions remembered before they are forgotten all at once.
constexpr size_t k_most_reaches = 4096;

// How far a box reaches along a direction.
double reach_of_box(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& direction) {
    return glm::dot(0.5 * (low + high), direction) + glm::dot(0.5 * (high - low), glm::abs(direction));
}

// World transform of a surface, or nothing where it is not drawn.
std::optional<glm::dmat4> placement(const Scene& scene, const Pose& pose, const PointSurface& surface) {
    const auto drawn = std::any_of(pose.draws.begin(), pose.draws.end(),
                                   [&](const DrawInstance& draw) { return draw.node == surface.node; });
    if (!drawn) {
        return std::nullopt;
    }
    const Node& node = scene.nodes[at(surface.node)];
    if (node.skin != k_none) {
        return glm::dmat4(1.0);
    }
    const glm::dmat4& world_from_node = pose.world_from_node[at(surface.node)];
    return node.instances.empty() ? world_from_node : world_from_node * node.instances[at(surface.instance)];
}

}  // namespace

double HullFinder::reach(int mesh, int primitive, const glm::dvec3& direction) {
    const auto key = std::pair(std::pair(mesh, primitive), std::array{direction.x, direction.y, direction.z});
    if (const auto found = reaches_.find(key); found != reaches_.end()) {
        return found->second;
    }
    if (reaches_.size() >= k_most_reaches) {
        reaches_.clear();
    }
    double reach = -1e300;
    for (const glm::vec3& position : scene_.meshes[at(mesh)].primitives[at(primitive)].positions) {
        reach = std::max(reach, glm::dot(glm::dvec3(position), direction));
    }
    reaches_.emplace(key, reach);
    return reach;
}

bool HullFinder::everything_below(const Pose& pose, const glm::dvec3& normal, double offset) {
    for (const DrawInstance& draw : pose.draws) {
        const Mesh& mesh = scene_.meshes[at(draw.mesh)];
        for (size_t p = 0; p < mesh.primitives.size(); ++p) {
            const Primitive& primitive = mesh.primitives[p];
            if (primitive.indices.empty()) {
                continue;
            }
            // Scenes put together by hand may lack the loader's boxes.
            PrimitiveBounds made;
            const PrimitiveBounds& bounds =
                primitive.bounds.all.empty() ? (made = primitive_bounds(primitive)) : primitive.bounds;
            if (draw.skin != k_none || !primitive.targets.empty()) {
                Bounds world;
                grow_by_primitive(world, pose, draw, bounds);
                if (!world.empty() && reach_of_box(world.low, world.high, normal) > offset) {
                    return false;
                }
                continue;
            }
            // The plane as the model sees it: the box answers for most, its vertices where the box does not.
            const glm::dmat3 linear(draw.world_from_model);
            const glm::dvec3 direction = glm::transpose(linear) * normal;
            const double room = offset - glm::dot(normal, glm::dvec3(draw.world_from_model[3]));
            if (reach_of_box(glm::dvec3(bounds.all.low), glm::dvec3(bounds.all.high), direction) > room &&
                reach(draw.mesh, static_cast<int>(p), direction) > room) {
                return false;
            }
        }
    }
    return true;
}

std::vector<bool> HullFinder::on_hull(const Pose& pose) {
    const Bounds bounds = world_bounds(scene_, pose);
    const double tolerance = k_tolerance * bounds.diagonal();
    std::vector<bool> out;
    for (const SurfacePart& part : parts_.parts) {
        bool hull = false;
        if (part.table->flat) {
            if (const auto m = placement(scene_, pose, parts_.surfaces[part.surface])) {
                const glm::dvec3 x((*m)[0]);
                const glm::dvec3 y((*m)[1]);
                const glm::dvec3 z((*m)[2]);
                const glm::dmat3 cofactor(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
                const glm::dvec3 across = cofactor * part.table->normal;
                const double length = glm::length(across);
                if (length > 0.0 && std::isfinite(length)) {
                    const glm::dvec3 normal = across / length;
                    const double offset =
                        glm::dot(normal, glm::dvec3(*m * glm::dvec4(part.table->point, 1.0)));
                    hull = everything_below(pose, normal, offset + tolerance) ||
                           everything_below(pose, -normal, -offset + tolerance);
                }
            }
        }
        out.push_back(hull);
    }
    return out;
}

}  // namespace bounce::scene
