// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/pose.h"
#include "scene/scene.h"

namespace bounce::scene {

// What animation changes of the nodes, before transforms are composed.
struct AnimatedState {
    std::vector<Transform> locals;
    std::vector<bool> visible;
    std::vector<std::vector<float>> weights;
};

[[nodiscard]] AnimatedState rest_state(const Scene& scene);

// Sets what the animation (or every one, k_all_animations) moves, in state and in the pose's lights,
// cameras, materials, world and view.
void play(const Scene& scene, double time_s, int animation, AnimatedState& state, Pose& pose);

// The scene's materials as the animation has them, and nothing else.
[[nodiscard]] std::vector<Material> play_materials(const Scene& scene, double time_s, int animation);

}  // namespace bounce::scene
