// SPDX-License-Identifier: Apache-2.0
#include "cli/view_options.h"

#include <cmath>

#include <fmt/format.h>

#include "core/error.h"

namespace bounce::cli {
namespace {

constexpr const char* k_group = "View transform (files other than .exr)";
// Beyond, two to so many stops is no float any more.
constexpr float k_most_stops = 64.0F;
// Blender's own slider ends here.
constexpr float k_most_gamma = 5.0F;

}  // namespace

void ViewOptions::add_to(CLI::App& command) {
    command
        .add_option(
            "--view-transform", view_transform,
            "Standard, Filmic, Raw and whatever else Blender's colour configuration has; the scene's own "
            "by default")
        ->group(k_group);
    command.add_option("--look", look, "A look by name, such as 'High Contrast', or None")->group(k_group);
    command.add_option("--display-device", display_device, "The screen, by name, such as sRGB")
        ->group(k_group);
    command.add_option("--exposure", exposure_stops, "Stops, before the view transform")
        ->check(CLI::Range(-k_most_stops, k_most_stops))
        ->group(k_group);
    command.add_option("--gamma", gamma, "Exponent 1 / gamma, after it")
        ->check(CLI::Range(0.0F, k_most_gamma))
        ->group(k_group);
}

bool ViewOptions::any() const {
    return display_device || view_transform || look || exposure_stops || gamma;
}

ViewTransform ViewOptions::over(ViewTransform scene) const {
    scene.display_device = display_device.value_or(scene.display_device);
    scene.view_transform = view_transform.value_or(scene.view_transform);
    scene.look = look.value_or(scene.look);
    scene.exposure = exposure_stops.value_or(scene.exposure);
    scene.gamma = gamma.value_or(scene.gamma);
    return scene;
}

ViewTransform ViewOptions::checked_over(const ViewTransform& scene) const {
    const ViewTransform view = over(scene);
    // Each name by itself beside what is always there, so that the scene's own never are to blame. Views are
    // of a display, whoever chose it.
    ViewTransform asked;
    if (display_device) {
        asked.display_device = *display_device;
    }
    if (view_transform) {
        asked.display_device = view.display_device;
        asked.view_transform = *view_transform;
    }
    if (look) {
        asked.look = *look;
    }
    if (const std::string unknown = unknown_name(asked); !unknown.empty()) {
        throw usage_error(unknown);
    }
    return view;
}

}  // namespace bounce::cli
