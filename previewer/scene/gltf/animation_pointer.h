// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/gltf/source.h"
#include "scene/scene.h"

namespace bounce::scene::gltf {

// What an animation channel moves, and how the file's numbers become ours.
struct ChannelTarget {
    Property property{};
    int index = 0;
    int components = 1;
    float factor = 1.0F;  // values are multiplied by it: lumens to watts, half angles to full
};

// The target of a KHR_animation_pointer, or nothing where it moves something that is not shown (with a
// warning) or that BOUNCE_scene describes better. khr_lights is read_lights' result. Throws Refusal
// where the pointer names an object that is not there.
[[nodiscard]] std::optional<ChannelTarget> resolve_pointer(Source& source, const Scene& scene,
                                                           const std::vector<int>& khr_lights,
                                                           const std::string& pointer);

// The target of a plain channel, which names a node and a path.
[[nodiscard]] std::optional<ChannelTarget> resolve_path(Source& source, const Scene& scene, int node,
                                                        const std::string& path);

}  // namespace bounce::scene::gltf
