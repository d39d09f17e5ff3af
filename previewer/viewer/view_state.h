// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "image/view_transform.h"
#include "renderer/settings.h"
#include "scene/scene.h"

namespace bounce::viewer {

// What the user chooses of how the picture is made and shown; keys and panels change the same values.
struct ViewState {
    Settings settings;            // the size is set from the window's before each frame
    float exposure_stops = 0.0F;  // on top of the scene's own
    int render_divisor = 1;       // 1, 2 or 4: the picture is so many times smaller than the window
    bool time_passes = false;
    bool show_panels = true;
    bool show_help = false;
};

// What the window does to the picture's colours. Layers of data are shown without the scene's look, as
// bounce render writes them.
[[nodiscard]] ViewTransform shown_view(const ViewState& state, const scene::ViewSettings& scene);

// Why the picture cannot be what was asked for; empty where it is. lights: that send light.
[[nodiscard]] std::string why_not_shown(const Settings& settings, size_t lights);

}  // namespace bounce::viewer
