// SPDX-License-Identifier: Apache-2.0
//
// What a frame costs, told beforehand: work of each kind counted from the scene and the settings, times what
// a unit of it took on the machine where docs/auto.md measured it. Arithmetic without OpenGL.
#pragma once

#include <string_view>
#include <vector>

#include "renderer/auto_scene.h"
#include "renderer/settings.h"

namespace bounce {

// One kind of work of a frame.
struct WorkItem {
    std::string_view name;  // a phrase for people
    double units = 0.0;     // of what the kind counts: pixels, texels, points, ...
    double ms = 0.0;        // on the measured machine
};

[[nodiscard]] std::vector<WorkItem> frame_work(const AutoScene& scene, const Settings& settings);

// Milliseconds of all of it together on that machine.
[[nodiscard]] double frame_cost_ms(const AutoScene& scene, const Settings& settings);

}  // namespace bounce
