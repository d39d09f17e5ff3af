// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/render_options.h"
#include "renderer/renderer.h"
#include "scene/scene.h"

namespace bounce::cli {

// What a frame would do: passes in order, what is left out and why, and the GPU memory it takes. frame:
// Blender's number. Opens OpenGL; draws nothing. Throws what rendering would.
struct InfoPlan {
    FrameReport report;
    Settings settings;
    int frame = 0;
    std::vector<std::string> choices;  // of preset auto, a sentence each
};
[[nodiscard]] InfoPlan info_plan(const scene::Scene& scene, const RenderOptions& options);

[[nodiscard]] nlohmann::json plan_json(const InfoPlan& plan);
void print_plan(const InfoPlan& plan);

}  // namespace bounce::cli
