// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/default_settings.h"

#include <algorithm>
#include <cmath>

namespace bounce::scene::gltf {
namespace {

// A white sky of this radiance lights a diffuse grey of 0.18 to 0.09, half of middle grey: bright
// enough to judge shape, far from clipping white surfaces.
constexpr float k_neutral_strength = 0.5F;
// Frame 1 is time 0 (docs/architecture.md, "Command line").
constexpr int k_first_frame = 1;
constexpr double k_fps = 24.0;

// Core glTF cannot say more than 1, so whoever does means a lamp and not a painted glow.
bool is_lamp(const Material& material) {
    return glm::any(glm::greaterThan(material.emission * material.emission_strength, glm::vec3(1.0F)));
}

bool has_light(const Scene& scene, const Node& node) {
    if (node.light != k_none) {
        return true;
    }
    if (node.mesh == k_none) {
        return false;
    }
    const auto& primitives = scene.meshes[static_cast<size_t>(node.mesh)].primitives;
    return std::any_of(primitives.begin(), primitives.end(), [&](const Primitive& primitive) {
        return primitive.material != k_none &&
               is_lamp(scene.materials[static_cast<size_t>(primitive.material)]);
    });
}

}  // namespace

void set_default_settings(Scene& scene) {
    double longest_s = 0.0;
    for (const Animation& animation : scene.animations) {
        longest_s = std::max(longest_s, static_cast<double>(animation.duration_s));
    }
    scene.frames.start = k_first_frame;
    scene.frames.fps = k_fps;
    // Bounded: a key may lie at any time, and frame numbers are ints.
    scene.frames.end = k_first_frame + static_cast<int>(std::min(std::round(longest_s * k_fps), 1e9));

    bool lit = false;
    for (const int index : scene.topological_order) {
        const Node& node = scene.nodes[static_cast<size_t>(index)];
        lit = lit || has_light(scene, node);
        if (scene.active_camera_node == k_none && node.camera != k_none) {
            scene.active_camera_node = index;
        }
    }
    scene.world.color = glm::vec3(1.0F);
    scene.world.strength = lit ? 0.0F : k_neutral_strength;
}

}  // namespace bounce::scene::gltf
