// SPDX-License-Identifier: Apache-2.0
//
// The same scene told in other numbers: its picture must not change, or change by a known factor. For tests
// of that, and for `bounce bench invariance`. Each takes a scene and gives it back changed, animation and all.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "scene/scene.h"

namespace bounce::scene {

// Every length times `factor` (above 0): vertices, nodes, bones, lights' sizes, cameras' frames and clipping.
// Power goes with its square; what is told a square metre (suns, the world, emission) stays. The picture is
// the same.
[[nodiscard]] Scene scaled(Scene scene, double factor);

// Moved as a whole, cameras and lights too, by one node above all: vertices and animation stay as they are.
// The picture is the same.
[[nodiscard]] Scene moved(Scene scene, const glm::dvec3& by);

// Turned as a whole about the origin, by one node above all; the world's image with it. The picture is the
// same.
[[nodiscard]] Scene turned(Scene scene, const glm::dquat& by);

// All light times `factor` (0 or above): lights, world, emission. Every pixel is `factor` times as bright.
[[nodiscard]] Scene relit(Scene scene, double factor);

}  // namespace bounce::scene
