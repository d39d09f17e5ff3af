// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "gpu/previous_pose.h"
#include "passes/gbuffer.h"

namespace bounce::passes {

// What a frame leaves of its bounced light to the next one, in textures that outlive it.
struct KeptLight {
    const gl::Texture* bounced = nullptr;  // RGBA32UI, shaders/lib/bounced.glsl
    const gl::Texture* depth = nullptr;    // as the G-buffer's
    const gl::Texture* normal = nullptr;   // RG16: the triangles' own
    const gl::Texture* frames = nullptr;   // R8UI: that a pixel's light is a mean of
};

// The frame before, and how this one stands to it.
struct LightBefore {
    KeptLight kept;
    gpu::UniformArena::Slot camera;            // MotionUniforms
    const gpu::PreviousPose* moved = nullptr;  // where the draws were; null: nothing but the camera moved
    float scale = 1.0F;                        // FrameUniforms::composite.w now over that of then
    int most_frames = 1;                       // that a mean may be of
};

struct TemporalReuseInputs {
    GBuffer gbuffer;
    View camera;
    TextureHandle unblurred;  // bounced light as it was gathered, interleaved
    TextureHandle bounced;    // the same, blurred
    int interleave = 1;
    std::optional<LightBefore> before;  // none: this frame's light is kept as it is
    KeptLight next;
};

// Pixels that show a surface, and those of them that took light of the frame before.
struct ReusedPixels {
    int surfaces = 0;
    int reused = 0;
};

// Bounced light as a running mean over frames, where the frame before saw the same place of the same surface
// and what it had agrees with this frame's own light up to what the choice of lights may change: the spread
// of what an interleaved block's pixels gather, each from other lights, says how much that is (the clip of
// Karis 2014, "High Quality Temporal Supersampling", around this frame's mean, with the lights' variance in
// the place of the neighbours'). Writes what the next frame takes. counted: filled for a wait, where it is
// not null.
[[nodiscard]] TextureHandle add_temporal_reuse(FrameGraph& graph, const PassContext& context,
                                               const TemporalReuseInputs& inputs, ReusedPixels* counted);

}  // namespace bounce::passes
