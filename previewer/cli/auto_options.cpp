// SPDX-License-Identifier: Apache-2.0
#include "cli/auto_options.h"

#include <algorithm>
#include <deque>

#include <fmt/format.h>

#include "core/error.h"
#include "core/log.h"
#include "scene/pose.h"

namespace bounce::cli {
namespace {

constexpr size_t k_trial_frames = 6;

}  // namespace

AutoUse choose_automatically(const RenderOptions& options, const scene::Scene& scene,
                             std::optional<double> target_relmse) {
    AutoUse out;
    out.used = options.automatic();
    if (target_relmse && !out.used) {
        throw usage_error(
            "--target-relmse without --converge chooses the settings by preset auto's curves; give no other "
            "preset and no --tuning beside it, or give --converge");
    }
    if (target_relmse && options.budget_ms) {
        throw usage_error("--target-relmse and --budget-ms both choose the settings; give one of them");
    }
    if (!out.used) {
        return out;
    }
    out.request = options.auto_request(scene);
    out.request.target_relmse = target_relmse;
    out.scene = options.described(scene, out.request.base);
    out.speed = options.machine_speed;
    out.choice = choose_settings(out.scene, out.request);
    return out;
}

void try_automatic(Renderer& renderer, const scene::Scene& scene, const RenderOptions& options, int animation,
                   const std::vector<int>& frames, AutoUse& use) {
    std::deque<scene::Pose> poses;  // that the moments refer to
    std::vector<Moment> moments;
    for (size_t i = 0; i < std::min(frames.size(), k_trial_frames); ++i) {
        const scene::Pose& pose = poses.emplace_back(
            scene::evaluate_pose(scene, scene::time_of_frame(scene.frames, frames[i]), animation));
        moments.push_back({pose, scene_camera(scene, pose, options.camera, use.request.base.width,
                                              use.request.base.height)});
    }
    AutoTrial trial = choose_on_trial(renderer, moments, use.scene, use.request);
    use.choice = std::move(trial.choice);
    use.speed = use.request.machine_speed = trial.machine_speed;
    use.measured_ms = trial.measured_ms;
    log::info(
        "settings for {:g} ms a frame, by {} frames on trial; --machine-speed {:.6g} chooses them again",
        *use.request.budget_ms, trial.frames, trial.machine_speed);
    if (!use.choice.fits || trial.measured_ms > *use.request.budget_ms) {
        log::warning(
            "nothing fits into {:g} ms at {}x{}: a frame took {:.3g} ms on trial at the cheapest settings",
            *use.request.budget_ms, use.choice.settings.width, use.choice.settings.height, trial.measured_ms);
    }
}

void check_targets(const RenderOptions& options, const ConvergeOptions& converge) {
    if (converge.converge && options.budget_ms && options.tuning.empty()) {
        throw usage_error(
            "--budget-ms is of a frame by itself; with --converge give --time-limit, in seconds, instead");
    }
}

std::vector<std::string> choice_lines(const AutoUse& use) {
    std::vector<std::string> lines = explain(use.choice);
    if (use.measured_ms) {
        lines.push_back(fmt::format("On trial a frame took {:.3g} ms.", *use.measured_ms));
    }
    return lines;
}

void print_choice(const AutoUse& use) {
    for (const std::string& line : choice_lines(use)) {
        fmt::print("{}\n", line);
    }
}

nlohmann::ordered_json automatic_json(const AutoUse& use) {
    nlohmann::ordered_json out = {{"seen_share", use.scene.seen_share},
                                  {"lights", use.scene.lights()},
                                  {"triangles", use.scene.features.triangles}};
    const auto number = [](const std::optional<double>& value) {
        return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
    };
    out["budget_ms"] = number(use.request.budget_ms);
    out["target_relmse"] = number(use.request.target_relmse);
    out["machine_speed"] = number(use.speed);
    out["trial_ms"] = number(use.measured_ms);
    out["predicted_ms"] = use.choice.predicted_ms;
    out["predicted_relmse"] = use.choice.predicted_relmse;
    out["fits"] = use.choice.fits;
    out["reasons"] = nlohmann::ordered_json::array();
    for (const AutoReason& reason : use.choice.reasons) {
        out["reasons"].push_back({{"choice", reason.choice}, {"why", reason.text}});
    }
    return out;
}

}  // namespace bounce::cli
