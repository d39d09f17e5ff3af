// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "frame_graph/frame_graph.h"
#include "gl/pass_timer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gpu/gpu_scene.h"
#include "gpu/previous_pose.h"
#include "gpu/uniform_arena.h"
#include "passes/motion.h"
#include "renderer/camera_view.h"
#include "renderer/settings.h"

namespace bounce {

// The scene at a moment, and who looks at it.
struct Moment {
    const scene::Pose& pose;
    CameraView camera;
};

// Of a camera, in render space.
[[nodiscard]] gpu::MotionUniforms motion_uniforms(const CameraMatrices& camera, const Settings& settings,
                                                  const gpu::RenderSpace& space);

// Draws the frame before, as far as the motion layer needs it: deformed vertices and depth. Nothing else
// makes one, so that nothing else pays for a second vertex stream.
class PreviousFrameSource {
  public:
    // Poses the scene at the moment before and leaves it there: the caller poses it again. Uses the arena
    // from empty. Appends the passes that ran.
    void draw(gpu::GpuScene& scene, gl::ProgramCache& programs, TransientPool& pool,
              gpu::UniformArena& uniforms, const Moment& before, const Settings& settings,
              gl::PassTimer& timer, std::vector<std::string>& executed);

    // After the scene has its pose of now: what the motion pass reads. Adds its uniforms to the arena.
    [[nodiscard]] passes::PreviousFrame match(const gpu::GpuScene& scene, const scene::Pose& now,
                                              const scene::Pose& before, gpu::UniformArena& uniforms);

  private:
    gpu::PreviousPose pose_;
    gl::Texture depth_;
    gpu::MotionUniforms motion_{};
};

}  // namespace bounce
