// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "image/view_transform.h"

namespace bounce::viewer {

// A view transform sampled on a cube of colours, for a shader to interpolate. Nodes are even in stops,
// because view transforms are; the range is the one of Blender's Filmic, 25 stops, and the count makes
// every node of Filmic's own table (65 a side) one of these.
constexpr int k_lattice_side = 129;
constexpr float k_lattice_low_stops = -12.473931F;
constexpr float k_lattice_high_stops = 12.526069F;

// RGB of every node, red fastest, then green, then blue, in 0..1. The first node of each axis stands for
// no light at all. Exposure and gamma are left to the shader: they may be animated.
[[nodiscard]] std::vector<float> bake_lattice(const ViewTransform& view);

}  // namespace bounce::viewer
