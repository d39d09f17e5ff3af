// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/settings.h"
#include "scene/scene.h"

namespace bounce::viewer {

// What the user chooses; keys and panels change the same values.
struct ViewState {
    Settings settings;             // the size is set from the window's before each frame
    float exposure_stops = 0.0F;   // on top of the scene's own
    int render_divisor = 1;        // 1, 2 or 4: the picture is so many times smaller than the window
    int camera_node = scene::k_none;
    bool free_camera = false;      // moved by the mouse away from camera_node
    bool time_passes = false;
    bool show_panels = true;
    bool show_help = false;
};

[[nodiscard]] inline bool shows_light(Show show) {
    return show == Show::shaded || show == Show::direct || show == Show::indirect;
}

[[nodiscard]] inline bool shows_rsm_layer(Show show) {
    return show == Show::rsm_depth || show == Show::rsm_position || show == Show::rsm_normal || show == Show::rsm_flux;
}

}  // namespace bounce::viewer
