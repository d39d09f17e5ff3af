// SPDX-License-Identifier: Apache-2.0
//
// What leaving out saves: the same frames with everything done that the scene does not need, with each frame
// drawn afresh, and as the plan has them, in turn.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "bench/experiments.h"
#include "bench/motions.h"
#include "core/stopwatch.h"
#include "gl/memory.h"
#include "image/metrics.h"

namespace bounce::bench {
namespace {

constexpr int k_frames = 9;
constexpr int k_quick_frames = 3;
constexpr double k_turn_deg = 3.0;  // a frame of the turntable: 120 frames around
constexpr int k_width = 480;
constexpr int k_height = 270;

// Most that forcing what is left out by an estimate may change a picture: the sampling error of bounced
// light, which other points in the shadow maps draw anew.
constexpr double k_estimate_bound = 0.01;

struct Mode {
    const char* name;
    Forced forced;
    bool keeps;
};
constexpr std::array<Mode, 4> k_modes = {{{"everything forced", Forced::all, false},
                                          {"all that is exact forced", Forced::exact, false},
                                          {"each frame afresh", Forced::nothing, false},
                                          {"the plan", Forced::nothing, true}}};
constexpr size_t k_plan = 3;

Settings forced(Settings settings, const Mode& mode) {
    settings.forced = mode.forced;
    return settings;
}

// One mode's renderer and what it took.
struct Runner {
    std::unique_ptr<Renderer> renderer;
    Samples time;
    FrameReport report;  // of the last frame
    double worst = 0.0;  // largest difference from the plan's picture, a channel
    double relmse = 0.0;
};

double largest_difference(const Image& a, const Image& b) {
    double worst = 0.0;
    for (size_t i = 0; i < a.rgb.size(); ++i) {
        const double difference = std::abs(static_cast<double>(a.rgb[i]) - static_cast<double>(b.rgb[i]));
        worst = std::isfinite(difference) ? std::max(worst, difference) : difference;
        if (std::isnan(worst)) {
            break;
        }
    }
    return worst;
}

std::array<Runner, 4> run(const BenchInputs& inputs, const Settings& settings, const Motion& motion,
                          int frames) {
    std::array<Runner, 4> out;
    for (size_t m = 0; m < k_modes.size(); ++m) {
        out[m].renderer = std::make_unique<Renderer>(inputs.scene);
        out[m].renderer->expect_frames(k_modes[m].keeps);
    }
    for (int frame = 0; frame < frames; ++frame) {
        inputs.interrupts.throw_if_interrupted("nothing is written");
        const Shot shot = motion.shot(frame);
        std::array<Image, 4> pictures;
        for (size_t m = 0; m < k_modes.size(); ++m) {
            Runner& runner = out[m];
            glFinish();
            const Stopwatch watch;
            runner.report = runner.renderer->render(shot.pose, shot.camera, forced(settings, k_modes[m]));
            glFinish();
            if (frame > 0) {  // the first compiles shaders and makes points
                runner.time.ms.push_back(watch.ms());
            }
            runner.renderer->keep_frame();
            pictures[m] = runner.renderer->read_color();
        }
        for (size_t m = 0; m < k_modes.size(); ++m) {
            out[m].worst = std::max(out[m].worst, largest_difference(pictures[m], pictures[k_plan]));
            out[m].relmse = std::max(out[m].relmse, relmse(pictures[m], pictures[k_plan]));
        }
    }
    return out;
}

// Of a renderer by itself, textures and buffers, MiB.
double peak_mebibytes(const BenchInputs& inputs, const Settings& settings, const Motion& motion,
                      const Mode& mode) {
    const size_t before = gl::allocated_bytes();
    Renderer renderer(inputs.scene);
    renderer.expect_frames(mode.keeps);
    gl::restart_peak();
    for (int frame = 0; frame < 3; ++frame) {
        const Shot shot = motion.shot(frame);
        (void)renderer.render(shot.pose, shot.camera, forced(settings, mode));
        renderer.keep_frame();
    }
    return static_cast<double>(gl::peak_allocated_bytes() - before) / gl::k_mebibyte;
}

Table passes_table(const std::string& motion, const std::array<Runner, 4>& runs) {
    Table table{.title = "Passes of the last frame: " + motion,
                .note = "",
                .columns = {{"pass", ""}, {"forced", ""}, {"plan", ""}, {"why it is left out", ""}},
                .rows = {}};
    std::vector<std::string> names;
    for (const size_t m : {size_t{0}, k_plan}) {
        for (const std::string& name : runs[m].report.executed) {
            if (std::find(names.begin(), names.end(), name) == names.end()) {
                names.push_back(name);
            }
        }
    }
    const auto count = [&](size_t m, const std::string& name) {
        const std::vector<std::string>& all = runs[m].report.executed;
        return static_cast<double>(std::count(all.begin(), all.end(), name));
    };
    const std::vector<LeftOut>& left_out = runs[k_plan].report.left_out;
    for (const std::string& name : names) {
        const auto reason = std::find_if(left_out.begin(), left_out.end(),
                                         [&](const LeftOut& item) { return item.pass == name; });
        table.rows.push_back({name, count(0, name), count(k_plan, name),
                              reason == left_out.end() ? std::string() : reason->reason});
    }
    for (const LeftOut& item : left_out) {
        if (std::find(names.begin(), names.end(), item.pass) == names.end()) {
            table.rows.push_back({item.pass, "", 0.0, item.reason});
        }
    }
    return table;
}

}  // namespace

void measure_leaving_out(const BenchInputs& inputs, BenchReport& report) {
    Settings settings = inputs.settings();
    if (!inputs.options.width && !inputs.options.quick) {
        settings.width = k_width;
        settings.height = k_height;
    }
    change_setting(report, "size", fmt::format("{}x{}", settings.width, settings.height));
    const int frames = inputs.options.quick ? k_quick_frames : k_frames;
    std::vector<Motion> motions;
    for (Motion& motion : scene_motions(inputs, settings, 0.004, report)) {
        if (motion.name == "the scene's animation") {
            motions.push_back(std::move(motion));
        }
    }
    motions.push_back(turntable(inputs, settings, k_turn_deg));
    Table times{
        .title = "A frame, as the same frames are drawn in turn",
        .note = fmt::format("Medians of {} frames after the first. Forcing what is exact changes nothing; "
                            "forcing the rest draws bounced light's shadows anew.",
                            frames - 1),
        .columns = {{"what moves", ""},
                    {"everything forced", "ms"},
                    {"exact forced", "ms"},
                    {"afresh", "ms"},
                    {"the plan", "ms"},
                    {"everything over plan", "times"},
                    {"afresh over plan", "times"},
                    {"worst difference, exact", ""},
                    {"worst difference, afresh", ""},
                    {"relMSE, everything", ""}},
        .rows = {}};
    Table memory{.title = "Peak of GPU memory, textures and buffers",
                 .note = "",
                 .columns = {{"what moves", ""},
                             {"everything forced", "MiB"},
                             {"exact forced", "MiB"},
                             {"afresh", "MiB"},
                             {"the plan", "MiB"}},
                 .rows = {}};
    std::vector<Table> passes;
    for (const Motion& motion : motions) {
        const std::array<Runner, 4> runs = run(inputs, settings, motion, frames);
        std::vector<Cell> row = {motion.name};
        std::vector<Cell> bytes = {motion.name};
        for (size_t m = 0; m < k_modes.size(); ++m) {
            row.emplace_back(runs[m].time.median());
            bytes.emplace_back(peak_mebibytes(inputs, settings, motion, k_modes[m]));
        }
        const double plan = runs[k_plan].time.median();
        row.emplace_back(runs[0].time.median() / plan);
        row.emplace_back(runs[2].time.median() / plan);
        row.emplace_back(runs[1].worst);
        row.emplace_back(runs[2].worst);
        row.emplace_back(runs[0].relmse);
        times.rows.push_back(row);
        memory.rows.push_back(bytes);
        passes.push_back(passes_table(motion.name, runs));
        const bool still_set = &motion == &motions.back();
        report.checks.push_back({.what = motion.name + ": everything forced over the plan",
                                 .value = runs[0].time.median() / plan,
                                 .kind = Check::Kind::at_least,
                                 .limit = still_set ? 5.0 : 1.5,
                                 .unit = "times"});
        report.checks.push_back(
            {.what = motion.name + ": worst difference where exact things are forced or redone",
             .value = std::max(runs[1].worst, runs[2].worst),
             .kind = Check::Kind::at_most,
             .limit = 0.0,
             .unit = ""});
        report.checks.push_back({.what = motion.name + ": relMSE of everything forced against the plan",
                                 .value = runs[0].relmse,
                                 .kind = Check::Kind::at_most,
                                 .limit = k_estimate_bound,
                                 .unit = ""});
    }
    report.tables.push_back(std::move(times));
    report.tables.push_back(std::move(memory));
    report.tables.insert(report.tables.end(), passes.begin(), passes.end());
}

}  // namespace bounce::bench
