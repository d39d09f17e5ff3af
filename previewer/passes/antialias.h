// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/gbuffer.h"

namespace bounce::passes {

// Smooths the outlines of a picture that was shaded once a pixel, into `target`, an imported RGBA32F texture:
// the scene's depth is drawn again at four samples a pixel, each sample takes the colour of that pixel nearby
// whose surface it lies on, and samples are weighed by Cycles' own pixel filter
// (shaders/passes/antialias.comp).
[[nodiscard]] TextureHandle add_antialias(FrameGraph& graph, const PassContext& context,
                                          const GBuffer& gbuffer, const View& camera, TextureHandle picture,
                                          TextureHandle target);

}  // namespace bounce::passes
