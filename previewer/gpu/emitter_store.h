// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "gl/buffer.h"
#include "gpu/point_store.h"
#include "gpu/shared_types.h"
#include "scene/points/emitters.h"

namespace bounce::gpu {

// Samples of the scene's emissive surfaces on the GPU, and the lights that passes/emitter_lights.comp makes
// of them.
class EmitterStore {
  public:
    // Both must outlive it; points: of the scene, for its surfaces.
    EmitterStore(const scene::Scene& scene, const PointStore& points);

    // Whether any surface may emit at some time.
    [[nodiscard]] bool empty() const { return emitters_.empty(); }

    // count: of lights. Samples anew where it changed, or a surface appeared or went; what is emitted may
    // change without moving a light.
    // panels: whose light something else draws. seed: other samples for each.
    void set_pose(const scene::Pose& pose, const VertexStore& vertices, size_t count,
                  std::span<const scene::EmissivePanel> panels, uint32_t seed = 0);

    // Lights at this pose; 0 where nothing emits.
    [[nodiscard]] size_t lights() const { return samples_.size(); }
    // What they send, luminance, W.
    [[nodiscard]] double power_w() const { return power_w_; }
    // What decides on the lights at this pose, but for where surfaces stand (PointStore::content()).
    [[nodiscard]] uint32_t content() const { return uploads_; }
    void bind_for_update() const;

  private:
    const scene::Scene& scene_;
    const PointStore& points_;
    scene::Emitters emitters_;
    std::vector<glm::vec3> peak_;          // one a material, over the file's animation
    std::vector<glm::vec3> sampled_peak_;  // what the samples are spread by
    std::vector<scene::EmitterSample> samples_;
    std::vector<glm::vec3> radiance_;         // one a material, as it was uploaded
    std::vector<bool> shown_;                 // one a surface
    std::vector<std::pair<int, int>> taken_;  // nodes and instances of the panels left out
    size_t count_ = 0;
    uint32_t seed_ = 0;
    uint32_t uploads_ = 0;
    double power_w_ = 0.0;
    gl::Buffer sources_;
    const gl::Buffer* positions_ = nullptr;
};

}  // namespace bounce::gpu
