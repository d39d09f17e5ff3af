// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/gbuffer.h"
#include "passes/soft_shadow.h"

namespace bounce::passes {

// Radiance reflected directly from one light, added to `sum` (an invalid handle starts a new picture).
// shadow_map is invalid where the light casts no hard shadow, soft where it casts no soft one.
[[nodiscard]] TextureHandle add_direct_light(FrameGraph& graph, const PassContext& context,
                                             const GBuffer& gbuffer, const LightPass& light,
                                             TextureHandle shadow_map, const SoftShadow& soft,
                                             TextureHandle sum);

}  // namespace bounce::passes
