// SPDX-License-Identifier: Apache-2.0
//
// Preset auto: settings from what a scene has and what is asked of a frame, with a sentence for each choice.
// A pure function; the curves behind it are in renderer/auto_knobs.cpp and docs/auto.md. No OpenGL.
#pragma once

#include <bitset>
#include <optional>
#include <string>
#include <vector>

#include "renderer/auto_scene.h"
#include "renderer/settings.h"

namespace bounce {

// What auto may turn. A setting that the user gave stays.
enum class Knob {
    technique,
    vpls,
    importance,
    ism_size,
    interleave,
    antialias,
    shadow_size,
    rsm_size,
    rsm_samples,
    world_vpls,
    bounce_vpls,
    emitter_vpls,
    shadow_samples,
    soft_shadow_size,
};
inline constexpr size_t k_knobs = 14;
using FixedKnobs = std::bitset<k_knobs>;  // one bit a Knob
[[nodiscard]] constexpr size_t bit_of(Knob knob) {
    return static_cast<size_t>(knob);
}

struct AutoRequest {
    Settings base;  // the picture's size, what the user gave, and the standard for the rest
    FixedKnobs fixed;
    // At most one of both. A time of a frame in milliseconds; an error against Cycles, relMSE.
    std::optional<double> budget_ms;
    std::optional<double> target_relmse;
    // How many times as fast as the machine that the times are of (docs/auto.md); with a budget alone.
    double machine_speed = 1.0;
};

struct AutoReason {
    std::string choice;  // options as one would give them: "--vpls 64"; empty where nothing is chosen by it
    std::string text;    // a sentence
};

struct AutoChoice {
    Settings settings;
    std::vector<AutoReason> reasons;
    double predicted_ms = 0.0;      // a frame, on this machine
    double predicted_relmse = 0.0;  // by the curves of the examples, within a factor of several
    bool fits = true;               // the budget or the target can be met
};

// Without budget and target quality comes first: the standard settings, but for what the scene calls for.
// With a budget the settings with the least error by the curves among those that take no longer; with a
// target the fastest that reach it. Where nothing does, the nearest, and `fits` is false and a reason says
// so.
[[nodiscard]] AutoChoice choose_settings(const AutoScene& scene, const AutoRequest& request);

// The speeds that a measurement is rounded to, so that two of them agree: powers of 2^(1/4).
[[nodiscard]] double speed_class(double speed);

// The reasons as lines of text, as --explain prints them.
[[nodiscard]] std::vector<std::string> explain(const AutoChoice& choice);

}  // namespace bounce
