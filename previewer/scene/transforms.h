// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

namespace bounce::scene {

[[nodiscard]] inline glm::dmat4 parent_from_local(const Transform& local) {
    glm::dmat4 matrix = glm::mat4_cast(local.rotation);
    matrix[0] *= local.scale.x;
    matrix[1] *= local.scale.y;
    matrix[2] *= local.scale.z;
    matrix[3] = glm::dvec4(local.translation, 1.0);
    return matrix;
}

// The identity where there is no direction left to keep.
[[nodiscard]] inline glm::dquat normalized_rotation(const glm::dquat& rotation) {
    const double length = glm::length(rotation);
    return length > 0.0 ? rotation / length : glm::dquat(1.0, 0.0, 0.0, 0.0);
}

}  // namespace bounce::scene
