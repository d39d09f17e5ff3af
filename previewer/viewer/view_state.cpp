// SPDX-License-Identifier: Apache-2.0
#include "viewer/view_state.h"

#include "renderer/settings_check.h"

namespace bounce::viewer {
ViewTransform shown_view(const ViewState& state, const scene::ViewSettings& scene) {
    ViewTransform view;
    if (shows_light(state.settings.show)) {
        view = {scene.display_device, scene.view_transform, scene.look, scene.exposure, scene.gamma};
    }
    view.exposure += state.exposure_stops;
    return view;
}

std::string why_not_shown(const Settings& settings, size_t lights) {
    if (settings.show == Show::shaded || settings.show == Show::direct) {
        return {};
    }
    if (const std::string refusal = layer_refusal(settings); !refusal.empty()) {
        const bool by_technique =
            settings.technique != Technique::ism && settings.show != Show::interpolation;
        return refusal + (by_technique                           ? "; T switches to another technique"
                          : settings.technique == Technique::rsm ? "; I switches it on"
                                                                 : "");
    }
    return lights == 0 ? "no light of the scene sends light, so there is no bounce to show" : "";
}

}  // namespace bounce::viewer
