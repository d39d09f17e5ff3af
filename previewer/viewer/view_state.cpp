// SPDX-License-Identifier: Apache-2.0
#include "viewer/view_state.h"

namespace bounce::viewer {
namespace {

bool shows_light(Show show) {
    return show == Show::shaded || show == Show::direct || show == Show::indirect;
}

}  // namespace

bool shows_rsm_layer(Show show) {
    return !shows_light(show) && show != Show::interpolation;
}

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
    if (settings.technique == Technique::direct) {
        return settings.show == Show::indirect
                   ? "technique direct has no indirect light; T switches to rsm"
                   : "technique direct has no reflective shadow maps to show; T switches to rsm";
    }
    if (lights == 0) {
        return "no light of the scene sends light, so there is no bounce to show";
    }
    if (settings.show == Show::interpolation && (!settings.interpolate || settings.rsm_full_sum)) {
        return "interpolation is off, so there is nothing to show of it; I switches it on";
    }
    return {};
}

}  // namespace bounce::viewer
