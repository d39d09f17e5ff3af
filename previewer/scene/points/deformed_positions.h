// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "scene/points/surface_parts.h"

namespace bounce::scene {

// Skinned or morphed by anything.
[[nodiscard]] bool primitive_deforms(const Node& node, const Primitive& primitive);

// World positions of a surface's vertices at a pose, morphed and skinned as shaders/passes/deform.comp does.
[[nodiscard]] std::vector<glm::dvec3> deformed_positions(const Scene& scene, const Pose& pose,
                                                         const PointSurface& surface);

}  // namespace bounce::scene
