// SPDX-License-Identifier: Apache-2.0
//
// Blended surfaces, layer by layer from the camera on (Everitt 2001, "Interactive Order-Independent
// Transparency").
#pragma once

#include <memory>

#include "passes/gbuffer.h"

namespace bounce::passes {

struct PeeledLayer {
    GBuffer gbuffer;
    std::shared_ptr<bool> any;  // whether a surface is in it; known when it was drawn, for a wait
};

// The blended surfaces next behind those of `before`, and before the solid ones; without `before`, the first
// ones. The G-buffer's depth is 0 where there are none.
[[nodiscard]] PeeledLayer add_peeled_layer(FrameGraph& graph, const PassContext& context, const View& camera,
                                           const GBuffer& solid, TextureHandle before, int number);

// Counts the pixels that have more blended surfaces behind the last layer, into *result; waits.
void count_unpeeled(FrameGraph& graph, const PassContext& context, const View& camera, const GBuffer& solid,
                    const GBuffer& last, int* result);

// A layer (radiance times alpha, and alpha) over the picture behind it, in place.
[[nodiscard]] TextureHandle add_over(FrameGraph& graph, const PassContext& context, TextureHandle layer,
                                     TextureHandle picture, int number);

}  // namespace bounce::passes
