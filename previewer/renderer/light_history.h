// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>

#include "gl/texture.h"
#include "gpu/gpu_scene.h"
#include "gpu/previous_pose.h"
#include "gpu/uniform_arena.h"
#include "passes/temporal_reuse.h"
#include "renderer/camera_view.h"
#include "renderer/settings.h"
#include "scene/pose.h"

namespace bounce {

// Why the light of one moment says nothing about another's: a phrase, empty where it does. A light that moved
// or changed, anything that emits, a material and a setting change bounced light everywhere at once.
[[nodiscard]] std::string light_changed(const scene::Scene& scene, const scene::Pose& before,
                                        const scene::Pose& now);
[[nodiscard]] std::string settings_changed(const Settings& before, const Settings& now);

// Bounced light of the frame before, and what that frame looked like. A frame may be drawn several times: it
// takes the same light each time, and what it made is the frame before from keep() on.
class LightHistory {
  public:
    struct Frame {
        passes::KeptLight next;
        std::optional<passes::LightBefore> before;
    };
    // How a frame stands to the one before.
    struct Continuation {
        std::string reason;  // why it takes nothing of it; empty: it does
        bool moved = false;  // a draw did
        // Of frames in a row that took light of the one before, this one included; it chooses their lights.
        uint32_t number = 0;
    };
    // After the scene has this pose and before anything deforms.
    [[nodiscard]] Continuation continuation(const gpu::GpuScene& scene, const scene::Pose& pose,
                                            const Settings& settings) const;
    // The same frame then. scale: FrameUniforms::composite.w. Adds uniforms to the arena.
    [[nodiscard]] Frame begin(const gpu::GpuScene& scene, const scene::Pose& pose,
                              const CameraMatrices& camera, const Settings& settings, float scale,
                              const Continuation& continuation, gpu::UniformArena& uniforms);
    void keep(const gpu::GpuScene& scene);
    void forget() { before_.reset(); }

  private:
    struct Textures {
        gl::Texture bounced, depth, normal, frames;
        [[nodiscard]] passes::KeptLight kept() const { return {&bounced, &depth, &normal, &frames}; }
    };
    struct Moment {
        scene::Pose pose;
        CameraMatrices camera;
        Settings settings;
        float scale = 1.0F;
        uint32_t number = 0;  // Continuation's
    };

    std::array<Textures, 2> textures_;
    size_t next_ = 0;  // of textures_: what is written; the other is the frame before's
    std::optional<Moment> before_, drawn_;
    gpu::PreviousPose previous_pose_;
    bool has_positions_ = false;
};

}  // namespace bounce
