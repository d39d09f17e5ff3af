// SPDX-License-Identifier: Apache-2.0
#include "cli/sweep_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/frame_list.h"
#include "core/atomic_file.h"
#include "core/log.h"
#include "evaluate/baseline.h"
#include "evaluate/sweep_axes.h"
#include "evaluate/sweep_text.h"
#include "evaluate/tuning.h"

namespace bounce::cli {
namespace {

ExitCode report_regressions(const Baseline& baseline, const Evaluation& evaluation, const std::string& name) {
    const BaselineReport report = compare_with_baseline(baseline, evaluation);
    if (!baseline.scene_sha256.empty() && baseline.scene_sha256 != evaluation.scene_sha256) {
        log::warning("{} has changed since the baseline {} was made", evaluation.scene, name);
    }
    for (const std::string& point : report.added) {
        log::info("note: {}: the run has this point, the baseline has not", point);
    }
    for (const std::string& regression : report.regressions) {
        log::error("{}", regression);
    }
    // A guard that compares fewer points than it was made for would narrow without anybody noticing.
    if (!report.missing.empty()) {
        log::error(
            "the baseline {} has points that this run lacks: {}; give the options that it was made with, "
            "or write a new one with --save-baseline",
            name, fmt::join(report.missing, "; "));
    }
    fmt::print("baseline {}: {} points compared, {} errors have risen, {} points are missing\n", name,
               report.compared, report.regressions.size(), report.missing.size());
    return report.passed() ? ExitCode::done : ExitCode::above_threshold;
}

}  // namespace

void SweepOptions::add_to(CLI::App& command) {
    command
        .add_option("--sweep", axes,
                    fmt::format("Bounce's settings along axes instead of the usual points: all, or {}",
                                sweep_axis_names()))
        ->delimiter(',')
        ->type_name("NAME,...");
    command
        .add_option(
            "--rounds", rounds,
            "Times that all points are measured, one after the other; the median is over all rounds, and "
            "the spread shows what changed on the machine meanwhile")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    command.add_flag("--resume", resume,
                     "Take points that an earlier run with the same inputs has left in the output folder");
    command.add_option(
        "--reference", reference,
        "Image to compare with instead of rendering one with Cycles, #### for the frame's number; "
        "without --cycles-spp Blender is not needed");
    command.add_option(
        "--baseline", baseline,
        "Earlier results.json or baseline: ends with 5 where an error has risen or a point of it is missing; "
        "times do not count");
    command.add_option("--save-baseline", save_baseline, "Write this run's errors as a baseline");
}

void SweepOptions::apply(const CLI::App& command, const std::filesystem::path& output,
                         EvaluateOptions& options) const {
    if (!axes.empty()) {
        options.runs = sweep_runs(axes, options.bounces);
    }
    options.point_folder = output / "points";
    options.resume = resume;
    options.rounds = rounds;
    if (!reference.empty()) {
        if (command.count("--reference-spp") > 0) {
            throw usage_error("--reference-spp has no effect with --reference, which is not rendered");
        }
        if (options.frames.size() > 1 && !has_frame_field(reference)) {
            throw usage_error(
                fmt::format("--reference {} is one image for {} frames; put #### where the frame's "
                            "number belongs",
                            reference, options.frames.size()));
        }
        options.given_reference = reference;
        if (command.count("--cycles-spp") == 0) {
            options.cycles_spp.clear();
        }
    }
    if (!baseline.empty()) {
        // Before the minutes of rendering, not after.
        require_same_conditions(read_baseline(baseline), {options.scene.filename().string(), options.width,
                                                          options.height, options.bounces, options.frames});
    }
    if (!save_baseline.empty()) {
        require_writable(save_baseline);
    }
}

ExitCode SweepOptions::finish(const Evaluation& evaluation, const std::filesystem::path& output) const {
    const Tuning tuning = tuning_of(evaluation);
    write_text_file(output / "tuning.json", tuning_json(tuning).dump(2) + "\n");
    fmt::print("{}{}", front_text(evaluation), budgets_text(tuning));
    if (!save_baseline.empty()) {
        write_text_file(save_baseline, baseline_json(evaluation).dump(2) + "\n");
    }
    return baseline.empty() ? ExitCode::done
                            : report_regressions(read_baseline(baseline), evaluation, baseline.string());
}

}  // namespace bounce::cli
