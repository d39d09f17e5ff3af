// SPDX-License-Identifier: Apache-2.0
#include "scene/primitive_bounds.h"

#include <algorithm>

namespace bounce::scene {

PrimitiveBounds primitive_bounds(const Primitive& primitive) {
    PrimitiveBounds bounds;
    for (const glm::vec3& position : primitive.positions) {
        bounds.all.grow(position);
    }
    for (const MorphTarget& target : primitive.targets) {
        Box& deltas = bounds.targets.emplace_back();
        for (const glm::vec3& delta : target.positions) {
            deltas.grow(delta);
        }
    }
    for (size_t v = 0; v < primitive.joints.size(); ++v) {
        for (glm::length_t k = 0; k < 4; ++k) {
            if (primitive.weights[v][k] > 0.0F) {
                const size_t joint = primitive.joints[v][k];
                bounds.joints.resize(std::max(bounds.joints.size(), joint + 1));
                bounds.joints[joint].grow(primitive.positions[v]);
            }
        }
    }
    return bounds;
}

}  // namespace bounce::scene
