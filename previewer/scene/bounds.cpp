// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "scene/pose.h"
#include "scene/primitive_bounds.h"

namespace bounce::scene {
namespace {

void grow_transformed(Bounds& bounds, const glm::dmat4& world_from_model, const Box& box) {
    if (box.empty()) {
        return;
    }
    for (unsigned corner = 0; corner < 8; ++corner) {
        const glm::dvec3 point((corner & 1U) != 0 ? box.high.x : box.low.x,
                               (corner & 2U) != 0 ? box.high.y : box.low.y,
                               (corner & 4U) != 0 ? box.high.z : box.low.z);
        bounds.grow(glm::dvec3(world_from_model * glm::dvec4(point, 1.0)));
    }
}

// Sum of the extremes of what each target adds.
void add_morph_extremes(const std::vector<Box>& targets, const std::vector<float>& weights, Box& box) {
    if (box.empty()) {
        return;
    }
    for (size_t t = 0; t < std::min(targets.size(), weights.size()); ++t) {
        if (!targets[t].empty()) {
            const glm::vec3 a = weights[t] * targets[t].low;
            const glm::vec3 b = weights[t] * targets[t].high;
            // A vertex that the target's list leaves out does not exist, so zero need not be included.
            box.low += glm::min(a, b);
            box.high += glm::max(a, b);
        }
    }
}

}  // namespace

void grow_by_primitive(Bounds& bounds, const Pose& pose, const DrawInstance& draw,
                       const PrimitiveBounds& primitive) {
    const std::vector<float>& weights = pose.weights[static_cast<size_t>(draw.node)];
    if (draw.skin == k_none) {
        Box box = primitive.all;
        add_morph_extremes(primitive.targets, weights, box);
        grow_transformed(bounds, draw.world_from_model, box);
        return;
    }
    // A skinned vertex is a weighted mean of where its joints take it, so it lies in the box around
    // those places.
    const std::vector<glm::dmat4>& joints = pose.skins[static_cast<size_t>(draw.skin)];
    for (size_t j = 0; j < std::min(joints.size(), primitive.joints.size()); ++j) {
        Box box = primitive.joints[j];
        add_morph_extremes(primitive.targets, weights, box);
        grow_transformed(bounds, joints[j], box);
    }
}

void Bounds::grow(const glm::dvec3& point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
}

void Bounds::grow(const Bounds& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
}

Bounds world_bounds(const Scene& scene, const Pose& pose) {
    Bounds bounds;
    for (const DrawInstance& draw : pose.draws) {
        for (const Primitive& primitive : scene.meshes[static_cast<size_t>(draw.mesh)].primitives) {
            // Scenes put together by hand may lack the loader's boxes.
            grow_by_primitive(bounds, pose, draw,
                              primitive.bounds.all.empty() ? primitive_bounds(primitive) : primitive.bounds);
        }
    }
    return bounds;
}

PlacedCamera framing_camera(const Bounds& bounds, double aspect) {
    // A product photographer's choice: 40 degrees keep a cube's edges nearly parallel; from the front
    // (glTF's +Z), a little right and above, three faces show.
    constexpr double vertical_fov_rad = 0.698;
    const glm::dvec3 from_center = glm::normalize(glm::dvec3(0.6, 0.45, 1.0));
    constexpr double margin = 1.05;
    // Without a scene, or with a single point, frame a unit sphere.
    const glm::dvec3 center = bounds.empty() ? glm::dvec3(0.0) : bounds.center();
    const double radius = bounds.diagonal() > 0.0 ? 0.5 * bounds.diagonal() : 1.0;

    const double half_vertical = 0.5 * vertical_fov_rad;
    const double half_horizontal = std::atan(std::tan(half_vertical) * (aspect > 0.0 ? aspect : 1.0));
    const double distance = margin * radius / std::sin(std::min(half_vertical, half_horizontal));

    PlacedCamera placed;
    placed.camera.name = "framing";
    placed.camera.perspective = true;
    placed.camera.yfov_rad = static_cast<float>(vertical_fov_rad);
    placed.camera.near_m = static_cast<float>(0.01 * (distance - radius));
    placed.camera.far_m = static_cast<float>(distance + 2.0 * radius);

    const glm::dvec3 z = from_center;
    const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), z));
    const glm::dvec3 y = glm::cross(z, x);
    placed.world_from_camera = glm::dmat4(glm::dvec4(x, 0.0), glm::dvec4(y, 0.0), glm::dvec4(z, 0.0),
                                          glm::dvec4(center + distance * from_center, 1.0));
    return placed;
}

}  // namespace bounce::scene
