// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gl/buffer.h"
#include "gpu/gpu_scene.h"
#include "scene/pose.h"

namespace bounce::gpu {

// Where vertices were at another moment, for motion: a second copy of the position stream, which holds that
// moment's skinned and morphed vertices, and that moment's transforms in the order of this moment's draws.
class PreviousPose {
  public:
    // Copies the positions as they are; call after the deform pass of the moment before.
    void keep_positions(const VertexStore& vertices);
    // Transforms of `before` for the draws that the scene has now, by node and, where a node has several
    // instances, by their place among them. What was not drawn then is marked.
    void match_draws(const GpuScene& scene, const scene::Pose& now, const scene::Pose& before);
    void bind() const;

  private:
    gl::Buffer positions_;
    gl::Buffer draws_;
};

}  // namespace bounce::gpu
