// SPDX-License-Identifier: Apache-2.0
//
// How fast this machine draws this scene, told by frames on trial: what a budget in milliseconds is worth in
// auto's units (renderer/auto_choice.h).
#pragma once

#include <span>

#include "renderer/auto_choice.h"
#include "renderer/renderer.h"

namespace bounce {

struct AutoTrial {
    AutoChoice choice;
    double machine_speed = 1.0;  // with which choose_settings() chooses the same
    double measured_ms = 0.0;    // a frame of the choice, the median of those on trial
    int frames = 0;              // drawn on trial, over all
};

// Draws what a first guess of the speed chooses, takes the speed from its time, and chooses again, until it
// has chosen twice the same; at most a handful of times. Of the choices that kept to the budget the one with
// the least error is taken, else the fastest. moments: what is drawn, one after the other and from the first
// again; at least one. Of several each is the frame before the next, so that what does not change between them
// is not paid for where the renderer keeps it (Renderer::expect_frames()). request: with a budget; its
// machine_speed is the first guess. Throws like Renderer::render().
[[nodiscard]] AutoTrial choose_on_trial(Renderer& renderer, std::span<const Moment> moments, const AutoScene& scene,
                                        const AutoRequest& request);

}  // namespace bounce
