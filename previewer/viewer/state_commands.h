// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "viewer/key_bindings.h"
#include "viewer/playback.h"
#include "viewer/view_state.h"

namespace bounce::viewer {

enum class Effect {
    none,             // only what lies over the picture, or how it is displayed
    picture_changed,  // the scene has to be drawn again
    not_here,         // the command needs more than the state: scene, window
};

// Carries out the commands that change the state and playback alone.
Effect perform_on_state(Command command, ViewState& state, Playback& playback, double now_s);

}  // namespace bounce::viewer
