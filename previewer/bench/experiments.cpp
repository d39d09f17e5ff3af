// SPDX-License-Identifier: Apache-2.0
#include "bench/experiments.h"

#include <algorithm>
#include <cassert>
#include <ctime>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "core/error.h"
#include "scene/pose.h"

namespace bounce::bench {
namespace {

constexpr int k_repeat = 5;

std::string timing_sentence(gl::TimingMode timing, int repeat) {
    const std::string how = timing == gl::TimingMode::finish
                                ? "passes by glFinish before and after each and a steady clock, in frames of "
                                  "their own (timer queries "
                                  "measure nothing on a software driver)"
                                : "passes by timer queries (GL_TIME_ELAPSED), in frames of their own";
    return fmt::format(
        "{}; frames by glFinish and a clock, without per-pass timing; after a warm-up, {} time{} each, the "
        "best "
        "counts unless it says median",
        how, repeat, repeat == 1 ? "" : "s");
}

std::string text_of(const Settings& settings) {
    return settings.ism_points > 0 ? std::to_string(settings.ism_points) : "automatic";
}

}  // namespace

double BenchInputs::frame_of(const scene::Scene& of) const {
    return options.frame ? *options.frame : of.frames.start;
}

int BenchInputs::repeat() const {
    return options.repeat.value_or(options.quick ? 1 : k_repeat);
}

Settings BenchInputs::settings() const {
    Settings out;
    out.width = options.width.value_or(options.quick ? 160 : 640);
    out.height = options.height.value_or(options.quick ? 90 : 360);
    out.technique = Technique::ism;
    out.vpls = options.vpls.value_or(out.vpls);
    out.ism_points = options.points.value_or(out.ism_points);
    out.ism_size = options.ism_size.value_or(out.ism_size);
    out.interleave = options.interleave.value_or(out.interleave);
    out.splat = options.splat.value_or(out.splat);
    return out;
}

FrameBench BenchInputs::bench(const scene::Scene& of) const {
    return {of, frame(), options.camera, timing, interrupts};
}

const std::vector<Experiment>& experiments() {
    static const std::vector<Experiment> all = {
        {"rates", "Splat and gather rates",
         "points splatted and VPLs evaluated a second, and what a frame spends on neither", measure_rates},
        {"rsm-table1", "Screen-space interpolation of reflective shadow maps",
         "time of a frame against samples and first pass, and light each pattern keeps (Table 1 of 2005)",
         measure_rsm_interpolation},
        {"ism-fig4", "Error of imperfect shadow maps",
         "error of ISMs against true shadow maps, over points and map size (the paper's Figure 4)",
         measure_ism_error},
        {"ism-fig9", "Time against VPLs, points, map size and triangles",
         "time of a frame and its parts against VPLs, points, map size and ten times the triangles (Figure "
         "9)",
         measure_ism_scaling},
        {"ism-table1", "Time against screen size",
         "time of a frame against screen size with blocks of 4, 8 and 16 (Table 1)", measure_screen_sizes},
        {"ism-creation", "Making imperfect and classic shadow maps",
         "time to make 256 ISMs against 256 classic shadow maps, 70,000 triangles or more",
         measure_ism_creation},
        {"ism-splats", "Splats of stored points and of tessellated triangles",
         "time to splat 10,000 to 8 M points by each path on three meshes, one deforming (Table 3 of 2013)",
         measure_splat_paths},
        {"temporal-reuse", "Bounced light of the frames before",
         "error, flicker and cost of --temporal-reuse while camera, object or light move",
         measure_temporal_reuse},
        {"lv-table1", "Frames a second with maps of simplified meshes",
         "frames a second of preset lv2009 by map size and shading, and of whole meshes (Table I of 2009)",
         measure_simplified_maps},
        {"lv-fig6", "Error against the size of maps of simplified meshes",
         "error and time of preset lv2009 against map size (Figure 6 of 2009)", measure_simplified_map_sizes},
        {"lv-fig7", "Error against pixel lights",
         "error and time of preset lv2009 against lights (Figure 7 of 2009)", measure_pixel_lights},
        {"avg-table1", "Stages of approximate visibility grids",
         "time of each stage of preset avg2012 against the scene's triangles (Table I of 2012)",
         measure_avg_stages},
        {"avg-table2", "Approximate visibility grids against screen size",
         "frames a second of preset avg2012 against screen size (Table II of 2012)", measure_avg_screens},
        {"leaving-out", "What leaving out saves",
         "time and memory of frames with everything done that the scene does not need, and without",
         measure_leaving_out},
        {"vpl-sampling", "Samplers of virtual point lights",
         "time, mean, flicker and error of each --vpl-sampling (Table 2, Figures 6 to 8 of 2013)",
         measure_vpl_sampling},
        {"furnace", "Closed rooms whose light is known",
         "mean radiance of closed white rooms by albedo, bounces and their source, against the exact one",
         measure_furnace},
        {"invariance", "Pictures of scenes told in other numbers",
         "difference that scaling, moving, turning, relighting, splitting, merging and reordering scenes "
         "make",
         measure_invariance, true},
        {"auto", "Preset auto within a time a frame",
         "time and error of preset auto within --budgets against every other preset's; takes many scenes",
         measure_auto_budgets, true},
        {"stress", "Stiff and extreme scenes",
         "whether each of some sixty generated scenes comes out as it must; ends with 5 where one does not",
         measure_stress},
    };
    return all;
}

const Experiment& find_experiment(std::string_view name) {
    std::string known;
    for (const Experiment& experiment : experiments()) {
        if (experiment.name == name) {
            return experiment;
        }
        known += fmt::format("{}{}", known.empty() ? "" : ", ", experiment.name);
    }
    throw usage_error(fmt::format("there is no experiment '{}'; there are {}", name, known));
}

BenchReport run_experiment(const Experiment& experiment, const BenchInputs& inputs,
                           const gl::DeviceInfo& device, const std::string& command) {
    BenchReport report;
    report.experiment = experiment.name;
    report.title = experiment.title;
    for (const scene::Scene& scene : inputs.scenes) {
        report.scene += (report.scene.empty() ? "" : ", ") + scene.name;
    }
    report.command = command;
    report.date = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
    report.machine = this_machine();
    report.gl_vendor = device.vendor;
    report.gl_renderer = device.renderer;
    report.gl_version = device.version;
    report.timing = timing_sentence(inputs.timing, inputs.repeat());
    const Settings settings = inputs.settings();
    report.settings = {{"frame", fmt::format("{:g}", inputs.frame())},
                       {"size", fmt::format("{}x{}", settings.width, settings.height)},
                       {"VPLs", std::to_string(settings.vpls)},
                       {"map size", std::to_string(settings.ism_size)},
                       {"points a map", text_of(settings)},
                       {"splat", splat_name(settings.splat)},
                       {"interleave", fmt::format("{0}x{0}", settings.interleave)},
                       {"bounces", std::to_string(settings.bounces)}};
    experiment.run(inputs, report);
    if (inputs.options.quick) {
        report.notes.emplace_back(
            "A quick run is smaller than what is to be reached was set for; whether it is met says little.");
    }
    return report;
}

std::string splat_name(Splat splat) {
    switch (splat) {
        case Splat::disks:
            return "disks";
        case Splat::compute:
            return "compute";
        case Splat::tessellation:
            return "tessellation";
        case Splat::automatic:
            return "auto";
        case Splat::points:
            break;
    }
    return "points";
}

void change_setting(BenchReport& report, std::string_view name, const std::string& value) {
    const auto found = std::find_if(report.settings.begin(), report.settings.end(),
                                    [&](const auto& setting) { return setting.first == name; });
    assert(found != report.settings.end());
    found->second = value;
}

std::vector<Column> part_columns(const Column& label) {
    std::vector<Column> columns = {label, {"frame", "ms"}, {"median", "ms"}};
    for (int part = 0; part < k_parts; ++part) {
        columns.push_back({part_name(static_cast<Part>(part)), "ms"});
    }
    return columns;
}

std::vector<Cell> part_row(const Cell& label, const MeasuredFrame& measured) {
    std::vector<Cell> row = {label, measured.frame.best(), measured.frame.median()};
    for (int part = 0; part < k_parts; ++part) {
        const Samples time = measured.part(static_cast<Part>(part));
        row.push_back(time.ms.empty() ? Cell{} : Cell{time.best()});
    }
    return row;
}

Plot part_plot(const std::string& title, const std::string& x_label,
               const std::vector<std::pair<std::string, MeasuredFrame>>& bars) {
    Plot plot{.title = title,
              .note = "Best times of the parts, each pass timed by itself.",
              .kind = Plot::Kind::stacked,
              .x_label = x_label,
              .y_label = "milliseconds",
              .x_log = false,
              .y_log = false,
              .series = {},
              .bar_names = {}};
    for (int part = 0; part < k_parts; ++part) {
        Series series{part_name(static_cast<Part>(part)), {}};
        for (size_t i = 0; i < bars.size(); ++i) {
            const Samples time = bars[i].second.part(static_cast<Part>(part));
            if (!time.ms.empty()) {
                series.points.push_back({static_cast<double>(i), time.best()});
            }
        }
        plot.series.push_back(std::move(series));
    }
    for (const auto& [name, measured] : bars) {
        plot.bar_names.push_back(name);
    }
    return plot;
}

size_t drawn_triangles(const scene::Scene& scene, double frame) {
    const scene::Pose pose = scene::evaluate_pose(scene, scene::time_of_frame(scene.frames, frame),
                                                  scene::default_animation(scene));
    size_t triangles = 0;
    for (const scene::DrawInstance& draw : pose.draws) {
        for (const scene::Primitive& primitive : scene.meshes[static_cast<size_t>(draw.mesh)].primitives) {
            triangles += primitive.indices.size() / 3;
        }
    }
    return triangles;
}

}  // namespace bounce::bench
