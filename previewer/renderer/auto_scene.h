// SPDX-License-Identifier: Apache-2.0
//
// What preset auto looks at before it chooses settings: a scene as numbers. Without OpenGL.
#pragma once

#include <string>

#include "scene/scene.h"
#include "scene/scene_features.h"

namespace bounce {

struct AutoScene {
    scene::SceneFeatures features;
    // Lights that send light, by what their maps are: one square, or the faces of a cube. Emissive panels,
    // which are drawn as area lights, are among the latter.
    int planar_lights = 0;
    int cube_lights = 0;
    // Of these, those with a size, which have a map for each of many places on them.
    int sized_planar = 0;
    int sized_cube = 0;
    bool emitters = false;  // emissive surfaces that are no panels
    bool blends = false;    // some surface is blended
    // Mean number of surfaces along a line through the scene (renderer/ism_layout.h).
    double depth_complexity = 1.0;
    // The share of the lights' light that counts for what the camera sees, unhidden: of what watts that fall
    // on surfaces show at its pixels after a bounce, the squared mean over the mean square. 1 where all show
    // the same, or nothing; 0.1 where it is as if a tenth showed all. Samples by flux have the noise of so
    // many by importance. The mean over the animation.
    double seen_share = 1.0;

    [[nodiscard]] int lights() const { return planar_lights + cube_lights; }
    [[nodiscard]] bool world() const { return features.world_not_black; }
    // Whether anything lights anything.
    [[nodiscard]] bool lit() const { return lights() > 0 || emitters || world(); }
};

// One description for all frames, so that an animation does not change its settings midway: lights and
// surfaces as they stand in the first frame (which lights send light: in any of a few), the camera's frame at
// a few moments. animation: as in evaluate_pose(). camera: a node's name; the active camera where it is
// empty. Throws usage_error for an unknown name.
[[nodiscard]] AutoScene describe_scene(const scene::Scene& scene, int animation, const std::string& camera,
                                       int width, int height);

}  // namespace bounce
