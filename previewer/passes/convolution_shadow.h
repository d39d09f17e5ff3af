// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/soft_shadow.h"

namespace bounce::passes {

// The share of a light with a size that each pixel sees, by convolution soft shadow maps (Annen et al. 2008;
// see shaders/lib/convolution.glsl) of light.soft's one map
// (add_soft_maps()): an estimate whose cost depends on no penumbra.
// Filters are rectangles, so a disk counts as a square, and end at a cube's edges.
[[nodiscard]] SoftShadow add_convolution_shadow(FrameGraph& graph, const PassContext& context,
                                                const GBuffer& gbuffer, const LightPass& light,
                                                TextureHandle maps);

}  // namespace bounce::passes
