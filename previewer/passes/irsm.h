// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/ism.h"

namespace bounce::passes {

// Imperfect reflective shadow maps (R32UI, shaders/lib/irsm.glsl) of a set of lights, in one atlas. set: as
// for the lights' shadow maps, but with the uniforms, size and points of these maps.
[[nodiscard]] TextureHandle add_irsm(FrameGraph& graph, const PassContext& context, const ScenePoints& scene,
                                     const VplSet& set);

}  // namespace bounce::passes
