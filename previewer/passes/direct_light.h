// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/gbuffer.h"

namespace bounce::passes {

// Radiance reflected directly from one light, added to `sum` (an invalid handle starts a new picture).
// shadow_map is invalid where the light casts none.
[[nodiscard]] TextureHandle add_direct_light(FrameGraph& graph, const PassContext& context,
                                             const GBuffer& gbuffer, const LightPass& light,
                                             TextureHandle shadow_map, TextureHandle sum);

}  // namespace bounce::passes
