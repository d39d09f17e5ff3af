// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "scene/pose.h"
#include "scene/scene.h"

namespace bounce::scene {

// What a scene has and does not have, over all of its time: from this the renderer decides which passes
// and shader branches it needs. Counts are of what the shown scene draws, instances included; a feature
// is true where any drawn mesh or used material has it.
struct SceneFeatures {
    uint64_t triangles = 0;
    uint64_t vertices = 0;
    int draws = 0;      // meshes drawn, instances counted
    int materials = 0;  // used by what is drawn
    int point_lights = 0;
    int spot_lights = 0;
    int sun_lights = 0;
    int area_lights = 0;

    bool skinned = false;
    bool morphed = false;
    bool base_color_texture = false;
    bool metallic_roughness_texture = false;
    bool normal_texture = false;
    bool emission_texture = false;
    bool vertex_colors = false;
    bool alpha_mask = false;
    bool alpha_blend = false;
    bool double_sided = false;
    bool emissive = false;
    bool unlit = false;
    bool glossy = false;  // any surface that mirrors more than a rough dielectric does
    bool disney_diffuse = false;
    bool reflects = false;  // any surface has a base colour that is not black and is lit
    bool world_not_black = false;

    bool animated_camera = false;
    bool animated_lights = false;    // moved, or changed in power, colour or shape
    bool animated_geometry = false;  // moved, deformed, or shown and hidden
    bool animated_materials = false;
    bool animated_world = false;

    [[nodiscard]] int lights() const { return point_lights + spot_lights + sun_lights + area_lights; }
    [[nodiscard]] bool textured() const {
        return base_color_texture || metallic_roughness_texture || normal_texture || emission_texture;
    }
    [[nodiscard]] bool animated() const {
        return animated_camera || animated_lights || animated_geometry || animated_materials ||
               animated_world;
    }
};

// animation as in evaluate_pose: only what it plays counts as animated.
[[nodiscard]] SceneFeatures scene_features(const Scene& scene, int animation = k_all_animations);

}  // namespace bounce::scene
