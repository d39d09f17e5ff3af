// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/pass_context.h"

namespace bounce::passes {

// Depth seen from a light: one layer, or six for a cube. Blended surfaces are cut out at one half, or left
// out where the light has maps of them alone.
[[nodiscard]] TextureHandle add_shadow_map(FrameGraph& graph, const PassContext& context,
                                           const LightPass& light);

}  // namespace bounce::passes
