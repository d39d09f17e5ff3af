// SPDX-License-Identifier: Apache-2.0
//
// What auto may turn, from the best value to the cheapest, and what each step costs in error: measured on the
// examples (docs/auto.md).
#pragma once

#include <string>
#include <vector>

#include "renderer/auto_choice.h"

namespace bounce {

struct KnobLevel {
    int value = 0;
    // relMSE above that of the best level, in the mean over the examples that have what the knob is about.
    double error = 0.0;
    bool standard = false;  // what settings are without budget and target
};

struct KnobCurve {
    Knob knob = Knob::technique;
    std::vector<KnobLevel> levels;  // falling quality
};

// Below this share of the light that counts for the camera (AutoScene::seen_share), lights are drawn by what
// it sees (docs/auto.md).
inline constexpr double k_little_seen = 0.25;

// Of a technique: those that change its picture of this scene, each with its levels.
[[nodiscard]] std::vector<KnobCurve> knob_curves(const AutoScene& scene, Technique technique);

// relMSE of a technique with the best level of every knob.
[[nodiscard]] double least_error(const AutoScene& scene, Technique technique);

void set_knob(Settings& settings, Knob knob, int value);
[[nodiscard]] int get_knob(const Settings& settings, Knob knob);

// Whether all that auto may turn is the same.
[[nodiscard]] bool same_knobs(const Settings& a, const Settings& b);
// Gives `to` all of it.
void take_knobs(const Settings& from, Settings& to);

// As options of the command line.
[[nodiscard]] std::string knob_option(Knob knob, int value);

// "256 virtual lights" and the like, for sentences.
[[nodiscard]] std::string knob_words(Knob knob, int value);

}  // namespace bounce
