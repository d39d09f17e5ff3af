// SPDX-License-Identifier: Apache-2.0
#include "viewer/state_commands.h"

#include <algorithm>

#include "renderer/ism_layout.h"

namespace bounce::viewer {
namespace {

Effect show(ViewState& state, Show what) {
    state.settings.show = what;
    return Effect::picture_changed;
}

Effect adjust_exposure(ViewState& state, float stops) {
    state.exposure_stops += stops;
    return Effect::none;
}

// Through -1, which stands for all, or the first.
Effect step_vpl(Settings& settings, int by) {
    const int places = ism_layout(settings, std::max(settings.shown_bounce, 1), 0).vpls + 1;
    settings.shown_vpl = (settings.shown_vpl + 1 + by + places) % places - 1;
    return Effect::picture_changed;
}

Effect toggle(bool& value, Effect effect) {
    value = !value;
    return effect;
}

}  // namespace

Effect perform_on_state(Command command, ViewState& state, Playback& playback, double now_s) {
    constexpr float half_stop = 0.5F;
    Settings& settings = state.settings;
    switch (command) {
        case Command::toggle_play:
            playback.toggle(now_s);
            return Effect::picture_changed;  // from the end it starts over
        case Command::previous_frame:
            playback.step(-1);
            return Effect::picture_changed;
        case Command::next_frame:
            playback.step(1);
            return Effect::picture_changed;
        case Command::first_frame:
            playback.seek(playback.range().start, now_s);
            return Effect::picture_changed;
        case Command::last_frame:
            playback.seek(playback.last_frame(), now_s);
            return Effect::picture_changed;
        case Command::show_shaded:
            return show(state, Show::shaded);
        case Command::show_direct:
            return show(state, Show::direct);
        case Command::show_indirect:
            return show(state, Show::indirect);
        case Command::show_rsm_depth:
            return show(state, Show::rsm_depth);
        case Command::show_rsm_position:
            return show(state, Show::rsm_position);
        case Command::show_rsm_normal:
            return show(state, Show::rsm_normal);
        case Command::show_rsm_flux:
            return show(state, Show::rsm_flux);
        case Command::show_interpolation:
            return show(state, Show::interpolation);
        case Command::show_vpls:
            return show(state, Show::vpls);
        case Command::show_ism:
            return show(state, Show::ism);
        case Command::show_vpl_visibility:
            return show(state, Show::vpl_visibility);
        case Command::previous_vpl:
            return step_vpl(settings, -1);
        case Command::next_vpl:
            return step_vpl(settings, 1);
        case Command::next_bounce:
            settings.shown_bounce = (settings.shown_bounce + 1) % (settings.bounces + 1);
            return Effect::picture_changed;
        case Command::darker:
            return adjust_exposure(state, -half_stop);
        case Command::brighter:
            return adjust_exposure(state, half_stop);
        case Command::toggle_technique:
            settings.technique = settings.technique == Technique::ism   ? Technique::rsm
                                 : settings.technique == Technique::rsm ? Technique::direct
                                                                        : Technique::ism;
            return Effect::picture_changed;
        case Command::toggle_interpolation:
            return toggle(settings.interpolate, Effect::picture_changed);
        case Command::toggle_panels:
            return toggle(state.show_panels, Effect::none);
        case Command::toggle_help:
            return toggle(state.show_help, Effect::none);
        default:
            return Effect::not_here;
    }
}

}  // namespace bounce::viewer
