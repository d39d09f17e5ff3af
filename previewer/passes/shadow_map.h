// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/pass_context.h"

namespace bounce::passes {

// Depth seen from a light: one layer, or six for a cube.
[[nodiscard]] TextureHandle add_shadow_map(FrameGraph& graph, const PassContext& context,
                                           const LightPass& light);

}  // namespace bounce::passes
