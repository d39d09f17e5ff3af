// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/gbuffer.h"

namespace bounce::passes {

struct CompositeInputs {
    GBuffer gbuffer;
    TextureHandle direct;      // invalid: none
    TextureHandle irradiance;  // invalid: none
    TextureHandle bounced;     // shaders/lib/bounced.glsl; invalid: none
    TextureHandle lobes;       // GatheredLight::lobes, blurred; invalid: the world's image is not reflected
    WorldImage image;          // without maps: the world has one colour
    TextureHandle radiance;    // what some surfaces reflect, added as it is; invalid: none
    bool world_light = false;
    bool emission = false;
    bool layer = false;  // the G-buffer is one of blended surfaces (passes/peel.h)
};

// Light of a frame that only surfaces reflect, as it leaves them, in a new texture: bounced light where the
// G-buffer has a surface, nothing elsewhere. For CompositeInputs::radiance.
[[nodiscard]] TextureHandle add_reflected(FrameGraph& graph, const PassContext& context,
                                          const GBuffer& gbuffer, TextureHandle bounced);

// Scene-linear radiance times film exposure (of a layer times alpha, with alpha beside it) into `target`, an
// RGBA32F texture; where that is invalid, into a new one.
TextureHandle add_composite(FrameGraph& graph, const PassContext& context, const CompositeInputs& inputs,
                            TextureHandle target);

}  // namespace bounce::passes
