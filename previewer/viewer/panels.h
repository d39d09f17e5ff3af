// SPDX-License-Identifier: Apache-2.0
//
// What lies over the picture. The panels change the view's state and ask for commands; they draw nothing
// of the scene and know nothing of OpenGL.
#pragma once

#include <string>
#include <vector>

#include "renderer/renderer.h"
#include "viewer/key_bindings.h"
#include "viewer/playback.h"
#include "viewer/stage.h"
#include "viewer/view_state.h"
#include "viewer/viewpoint.h"

namespace bounce::viewer {

// What the panels tell about.
struct PanelFacts {
    const Stage& stage;
    const FrameReport& report;
    const std::vector<gl::PassTime>& pass_times;
    const std::vector<std::string>& lights;  // that have a reflective shadow map
    const std::string& device;
    const std::string& message;  // the last thing done; empty when it has been there long enough
    const std::string& problem;  // stays until it is mended: why the changed file is not shown
    std::string note;            // why the picture is not what was asked for
    double frame_ms = 0.0;       // median
    double now_s = 0.0;
    float content_scale = 1.0F;
};

struct PanelResult {
    bool picture_changed = false;  // the scene has to be drawn again
    std::vector<Command> commands;
};

[[nodiscard]] PanelResult draw_panels(ViewState& state, Viewpoint& viewpoint, Playback& playback,
                                      const PanelFacts& facts);

}  // namespace bounce::viewer
