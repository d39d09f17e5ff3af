// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/previous_pose.h"
#include "passes/pass_context.h"

namespace bounce::passes {

// The frame before, as the motion layer needs it.
struct PreviousFrame {
    gpu::UniformArena::Slot uniforms;  // MotionUniforms
    const gpu::PreviousPose* pose = nullptr;
    const gl::Texture* depth = nullptr;  // of what its camera saw
};

// Depth of the scene as it is posed, into a texture that outlives the frame.
void add_previous_depth(FrameGraph& graph, const PassContext& context, const View& camera,
                        TextureHandle depth);

// add_motion() into a texture of its own (RGBA32F).
[[nodiscard]] TextureHandle add_motion_vectors(FrameGraph& graph, const PassContext& context,
                                               const View& camera, const PreviousFrame& previous);

// For each pixel where its point of surface was in the frame before: (dx, dy, distance), defined in
// docs/metrics.md; 0 where there is no surface.
void add_motion(FrameGraph& graph, const PassContext& context, const View& camera,
                const PreviousFrame& previous, TextureHandle target);

}  // namespace bounce::passes
