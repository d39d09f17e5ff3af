// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/vpl_gather.h"
#include "passes/vpl_sampling.h"

namespace bounce::passes {

struct NearFieldInputs {
    GBuffer gbuffer;
    std::vector<VplSource> sources;
    VplImportance importance;
    gpu::UniformArena::Slot uniforms;  // IsmUniforms of the lights
    int interleave = 1;
    uint32_t seed = 0;  // as of the lights (VplSet)
    float extent = 1.0F;
    bool glossy = false;
};

// Adds what lies within the near radius of the virtual point lights to what they were gathered into
// (add_vpl_gather with near_field).
[[nodiscard]] TextureHandle add_near_field(FrameGraph& graph, const PassContext& context,
                                           const NearFieldInputs& inputs, const GatheredLight& light);

}  // namespace bounce::passes
