// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/ism.h"

namespace bounce::passes {

// Splats of points that tessellation makes on the scene's triangles (Barak, Bittner and Havran 2013,
// "Temporally Coherent Adaptive Sampling for Imperfect Shadow Maps", 5.2), as depths in an atlas; 0 where
// there is none. A map has set.points_a_map of them in the mean.
[[nodiscard]] TextureHandle add_tessellation(FrameGraph& graph, const PassContext& context,
                                             const TessellatedPoints& points, const VplSet& set);

}  // namespace bounce::passes
