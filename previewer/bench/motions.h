// SPDX-License-Identifier: Apache-2.0
//
// Ways in which something of a scene moves, for experiments over time.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/experiments.h"
#include "renderer/camera_view.h"
#include "scene/pose.h"

namespace bounce::bench {

struct Shot {
    scene::Pose pose;
    CameraView camera;
};

struct Motion {
    std::string name;               // what moves
    bool still = false;             // nothing does
    std::function<Shot(int)> shot;  // by the frame's number, from 0
};

// Nothing, the camera (aside), an object, a light and the scene's animation, each alone and from the inputs'
// frame on. step: how far camera, object and light go in a frame, parts of the scene's diagonal; a sun turns
// by as many radians. Says in the report's notes what the scene does not have. The inputs outlive them.
[[nodiscard]] std::vector<Motion> scene_motions(const BenchInputs& inputs, const Settings& settings,
                                                double step, BenchReport& report);

// The camera goes around the middle of the scene, `step_deg` a frame, in which all else stands still.
[[nodiscard]] Motion turntable(const BenchInputs& inputs, const Settings& settings, double step_deg);

// The camera goes its animated way through the scene, in which all else stands still: a walk-through. Nothing
// where the animation does not move it.
[[nodiscard]] std::optional<Motion> walk_through(const BenchInputs& inputs, const Settings& settings);

}  // namespace bounce::bench
