// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include <glm/glm.hpp>

#include "renderer/settings.h"
#include "viewer/hot_reload.h"
#include "viewer/stage.h"

namespace bounce::viewer {

struct ViewerOptions {
    std::filesystem::path scene;  // the file that is watched for changes
    LoadScene load;               // reads it
    // Given the scene: what to render at first; width and height are the window's. Asked again for a scene
    // that is loaded again, with the picture's size, and where size_matters for a picture of another size.
    // Throws usage_error.
    std::function<Settings(const scene::Scene&, std::optional<glm::ivec2> size)> choose_settings;
    bool size_matters = false;
    ChooseAnimation choose_animation;
    std::string camera;        // node by name; the active one where empty
    std::optional<int> frame;  // to begin at
};

// Opens a window and returns when it is closed. Throws Error: no_opengl without a display, input_refused
// where the scene cannot be read.
void run_viewer(const ViewerOptions& options);

}  // namespace bounce::viewer
