// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/pass_context.h"

namespace bounce::passes {

// A light's reflective shadow map, RGBA32UI (shaders/lib/rsm.glsl), one layer or six.
[[nodiscard]] TextureHandle add_rsm(FrameGraph& graph, const PassContext& context, const LightPass& light);

}  // namespace bounce::passes
