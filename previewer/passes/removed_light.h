// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/gbuffer.h"

namespace bounce::passes {

// Means over the picture of the radiance that surfaces reflect, over its channels as well; scene-linear,
// before film exposure.
struct RemovedLight {
    double indirect = 0.0;  // by the light that was gathered
    double removed = 0.0;   // by what bounding the lights' kernels took away from it
    // Signed share of the indirect light that bounding takes away, 0 to -1: the bias it would be if the
    // lights stood at random places. In the middle of what they stand for, 1/d^2 overshoots near by, and part
    // of it is that.
    [[nodiscard]] double bias() const {
        return indirect + removed > 0.0 ? -removed / (indirect + removed) : 0.0;
    }
};

// Reads both sums back into result when the pass runs, which waits for the GPU. removed: invalid where
// nothing is. Both as in shaders/lib/bounced.glsl.
void add_removed_light(FrameGraph& graph, const PassContext& context, const GBuffer& gbuffer,
                       TextureHandle indirect, TextureHandle removed, RemovedLight* result);

}  // namespace bounce::passes
