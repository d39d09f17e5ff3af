// SPDX-License-Identifier: Apache-2.0
#include "scene/points/deformed_positions.h"

#include <algorithm>

namespace bounce::scene {

bool primitive_deforms(const Node& node, const Primitive& primitive) {
    return !primitive.targets.empty() || (node.skin != k_none && !primitive.joints.empty());
}

std::vector<glm::dvec3> deformed_positions(const Scene& scene, const Pose& pose,
                                           const PointSurface& surface) {
    const Node& node = scene.nodes[static_cast<size_t>(surface.node)];
    const Primitive& primitive =
        scene.meshes[static_cast<size_t>(surface.mesh)].primitives[static_cast<size_t>(surface.primitive)];
    std::vector<glm::dvec3> positions(primitive.positions.begin(), primitive.positions.end());
    const std::vector<float>& weights = pose.weights[static_cast<size_t>(surface.node)];
    for (size_t t = 0; t < std::min(weights.size(), primitive.targets.size()); ++t) {
        const MorphTarget& target = primitive.targets[t];
        if (weights[t] == 0.0F || target.positions.empty()) {
            continue;
        }
        for (size_t v = 0; v < positions.size(); ++v) {
            positions[v] += glm::dvec3(target.positions[v]) * static_cast<double>(weights[t]);
        }
    }
    if (node.skin != k_none && !primitive.joints.empty()) {
        const std::vector<glm::dmat4>& joints = pose.skins[static_cast<size_t>(node.skin)];
        for (size_t v = 0; v < positions.size(); ++v) {
            glm::dvec4 sum(0.0);
            for (glm::length_t k = 0; k < 4; ++k) {
                sum += joints[primitive.joints[v][k]] * glm::dvec4(positions[v], 1.0) *
                       static_cast<double>(primitive.weights[v][k]);
            }
            // Weights in floats sum up to 1 within a rounding, which far from the origin is a way to go.
            positions[v] = glm::dvec3(sum) / (sum.w > 0.0 ? sum.w : 1.0);
        }
        return positions;
    }
    // A skinned mesh's own node does not count, even where a primitive lacks joints.
    glm::dmat4 m =
        node.skin != k_none ? glm::dmat4(1.0) : pose.world_from_node[static_cast<size_t>(surface.node)];
    if (node.skin == k_none && !node.instances.empty()) {
        m = m * node.instances[static_cast<size_t>(surface.instance)];
    }
    for (glm::dvec3& position : positions) {
        position = glm::dvec3(m * glm::dvec4(position, 1.0));
    }
    return positions;
}

}  // namespace bounce::scene
