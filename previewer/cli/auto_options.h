// SPDX-License-Identifier: Apache-2.0
//
// Preset auto on the command line: what it is asked, and how it says what it has chosen.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/converge_options.h"
#include "cli/render_options.h"
#include "renderer/auto_trial.h"

namespace bounce::cli {

// What preset auto has chosen for a scene, and by what.
struct AutoUse {
    bool used = false;  // the settings are not of a paper's preset or a file
    AutoScene scene;
    AutoRequest request;
    AutoChoice choice;
    std::optional<double> speed;        // of the machine, given or measured
    std::optional<double> measured_ms;  // a frame on trial
    // Whether the machine's speed decides and is not known.
    [[nodiscard]] bool needs_trial() const { return used && request.budget_ms && !speed; }
};

// target_relmse: that a frame by itself is to reach. Throws usage_error like RenderOptions::settings(), and
// for a target with a budget or with another preset.
[[nodiscard]] AutoUse choose_automatically(const RenderOptions& options, const scene::Scene& scene,
                                           std::optional<double> target_relmse);

// Chooses again by frames on trial (choose_on_trial()), the first of `frames` by Blender's numbers. Says the
// machine's speed on stderr.
void try_automatic(Renderer& renderer, const scene::Scene& scene, const RenderOptions& options, int animation,
                   const std::vector<int>& frames, AutoUse& use);

// Refuses a budget for frames beside --converge, whose passes have no time of their own to keep.
void check_targets(const RenderOptions& options, const ConvergeOptions& converge);

// The sentences of --explain, on stdout; also those for what auto would choose for a scene that is only
// described.
void print_choice(const AutoUse& use);
[[nodiscard]] std::vector<std::string> choice_lines(const AutoUse& use);

// For --stats: features that decided, what was asked, and the sentences.
[[nodiscard]] nlohmann::ordered_json automatic_json(const AutoUse& use);

}  // namespace bounce::cli
