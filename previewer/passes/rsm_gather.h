// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "passes/gbuffer.h"

namespace bounce::passes {

// A light, its RSM and its part of the samples.
struct RsmSource {
    LightPass light;
    TextureHandle rsm;
    // FrameUniforms with this light's sample count.
    gpu::UniformArena::Slot frame;
    // Its sample pattern; outlives the frame.
    const gl::Buffer* pattern = nullptr;
};

struct GatherInputs {
    GBuffer gbuffer;
    std::vector<RsmSource> sources;
    bool full_sum = false;  // every texel instead of the pattern
};

// Irradiance (RGBA32F, full resolution) gathered at every pixel.
[[nodiscard]] TextureHandle add_rsm_gather(FrameGraph& graph, const PassContext& context,
                                           const GatherInputs& inputs);

// The same by the paper's section 4: one pixel in step x step, interpolation, full evaluation of the rest.
struct InterpolatedGather {
    TextureHandle irradiance;
    BufferHandle counts;  // uvec4: groups, 1, 1, pixels that were evaluated in full
};
[[nodiscard]] InterpolatedGather add_rsm_gather_interpolated(FrameGraph& graph, const PassContext& context,
                                                             const GatherInputs& inputs, int step);

}  // namespace bounce::passes
