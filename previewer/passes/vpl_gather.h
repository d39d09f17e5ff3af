// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "passes/gbuffer.h"
#include "passes/ism.h"

namespace bounce::passes {

struct VplGatherInputs {
    GBuffer gbuffer;
    std::vector<VplSet> sets;  // one a bounce; all of the same interleave
    bool slope_bias = false;   // the shadow maps' splats have one depth each
    bool near_field = false;   // leaves out of the first set what add_near_field() adds
    bool glossy = false;       // glossy lobes of lights and receivers
    bool removed = false;      // gathers what bounding the kernels takes away instead
};

// Bounced light (RGBA32UI, shaders/lib/bounced.glsl), interleaved over n x n pixels.
struct GatheredLight {
    TextureHandle bounced;
    TextureHandle
        lobes;  // where a set is of the world's image and lobes count: what of them is seen (RGBA32UI)
    TextureHandle reach;  // R16F: near radius of the lights that are near; invalid without near_field
};
[[nodiscard]] GatheredLight add_vpl_gather(FrameGraph& graph, const PassContext& context,
                                           const VplGatherInputs& inputs);

// The interleaved light averaged over n x n pixels of one surface; tent: over a tent twice as wide.
[[nodiscard]] TextureHandle add_bounced_blur(FrameGraph& graph, const PassContext& context,
                                             const GBuffer& gbuffer, TextureHandle bounced, int interleave,
                                             bool tent);

}  // namespace bounce::passes
