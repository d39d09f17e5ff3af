// SPDX-License-Identifier: Apache-2.0
//
// Figure 9 of the paper: what each parameter costs, one varied at a time; and what triangles cost.
#include <fmt/format.h>

#include "bench/experiments.h"
#include "scene/refine.h"

namespace bounce::bench {
namespace {

constexpr double k_triangle_factor = 10.0;
constexpr double k_most_growth = 1.2;  // of the indirect light's time

struct Sweep {
    std::string name;  // of what varies
    std::vector<int> values;
    void (*set)(Settings& settings, int value);
};

void add_sweep(const BenchInputs& inputs, FrameBench& bench, Progress& progress, const Sweep& sweep,
               BenchReport& report, Plot& frames) {
    Table table{.title = fmt::format("Time against {}", sweep.name),
                .note = "",
                .columns = part_columns({sweep.name, ""}),
                .rows = {}};
    Series series{sweep.name, {}};
    std::vector<std::pair<std::string, MeasuredFrame>> bars;
    for (const int value : sweep.values) {
        Settings settings = inputs.settings();
        sweep.set(settings, value);
        MeasuredFrame measured = bench.measure(settings, inputs.repeat());
        progress.step(fmt::format("{} {}: {:.1f} ms", sweep.name, value, measured.frame.best()));
        table.rows.push_back(part_row(static_cast<double>(value), measured));
        // In multiples of the sweep's first value, so that all of them share an axis.
        series.points.push_back({static_cast<double>(value) / sweep.values.front(), measured.frame.best()});
        bars.emplace_back(std::to_string(value), std::move(measured));
    }
    series.name += fmt::format(" (1 is {})", sweep.values.front());
    report.tables.push_back(std::move(table));
    report.plots.push_back(part_plot(fmt::format("Time against {}", sweep.name), sweep.name, bars));
    frames.series.push_back(std::move(series));
}

void add_triangles(const BenchInputs& inputs, FrameBench& bench, Progress& progress, BenchReport& report) {
    scene::Scene refined = inputs.scene;
    scene::refine_scene(refined, scene::refinement_by(k_triangle_factor));
    FrameBench refined_bench = inputs.bench(refined);
    const Settings settings = inputs.settings();
    const MeasuredFrame few = bench.measure(settings, inputs.repeat());
    progress.step(fmt::format("{} triangles: {:.1f} ms", few.report.triangles, few.frame.best()));
    const MeasuredFrame many = refined_bench.measure(settings, inputs.repeat());
    progress.step(fmt::format("{} triangles: {:.1f} ms", many.report.triangles, many.frame.best()));

    const std::string few_name = fmt::format("{} triangles", few.report.triangles);
    const std::string many_name = fmt::format("{} triangles", many.report.triangles);
    const double ratio =
        static_cast<double>(many.report.triangles) / static_cast<double>(few.report.triangles);
    Table table{.title = "Ten times the triangles",
                .note = fmt::format("Triangles split without moving the surface: {:.4g} times as many. Maps: "
                                    "{} large triangles and {} points "
                                    "each before, {} and {} after.",
                                    ratio, few.report.large_triangles, few.report.points_a_map,
                                    many.report.large_triangles, many.report.points_a_map),
                .columns = {{"part", ""}, {few_name, "ms"}, {many_name, "ms"}, {"ratio", ""}},
                .rows = {}};
    const auto add = [&](const std::string& name, const Samples& before, const Samples& after) {
        if (!before.ms.empty()) {
            table.rows.push_back({name, before.best(), after.best(), after.best() / before.best()});
        }
        return after.best() / before.best();
    };
    for (int part = 0; part < k_parts; ++part) {
        add(part_name(static_cast<Part>(part)), few.part(static_cast<Part>(part)),
            many.part(static_cast<Part>(part)));
    }
    const auto from_points = [](const MeasuredPass& pass) {
        return pass.part != Part::direct && pass.part != Part::rsm;
    };
    const double without_rsm =
        add("indirect light without RSMs", few.sum(from_points), many.sum(from_points));
    const double indirect = add("indirect light", few.indirect(), many.indirect());
    add("frame", few.frame, many.frame);
    report.tables.push_back(std::move(table));
    report.plots.push_back(part_plot("Ten times the triangles", "", {{few_name, few}, {many_name, many}}));
    report.checks.push_back({fmt::format("{:.3g} times the triangles: time of indirect light", ratio),
                             indirect, Check::Kind::at_most, k_most_growth, "times"});
    report.checks.push_back(
        {fmt::format(
             "{:.3g} times the triangles: indirect light without the RSMs, which are drawn from triangles",
             ratio),
         without_rsm, Check::Kind::at_most, k_most_growth, "times"});
}

// The settings whose times the paper breaks down, with its splats.
void add_paper_breakdown(const BenchInputs& inputs, FrameBench& bench, Progress& progress,
                         BenchReport& report) {
    Settings settings = inputs.settings();
    settings.vpls = 1024;
    settings.ism_size = 256;
    settings.ism_points = 8192;
    settings.interleave = 8;
    settings.splat = Splat::compute;
    settings.pull_push = PullPush::paper;
    settings.width = 640;
    settings.height = 480;
    if (inputs.options.quick) {
        settings.vpls = 64;
        settings.width = inputs.settings().width;
        settings.height = inputs.settings().height;
    }
    const MeasuredFrame measured = bench.measure(settings, inputs.repeat());
    progress.step(fmt::format("the paper's settings: {:.1f} ms", measured.frame.best()));
    const auto pull_push = [](const MeasuredPass& pass) { return pass.name == "ism pull-push"; };
    const auto splat = [&](const MeasuredPass& pass) { return pass.part == Part::maps && !pull_push(pass); };
    const auto rsm = [](const MeasuredPass& pass) {
        return pass.part == Part::rsm || pass.part == Part::vpls;
    };
    const auto blur = [](const MeasuredPass& pass) { return pass.name.starts_with("blur"); };
    const auto near = [&](const MeasuredPass& pass) { return pass.part == Part::finish && !blur(pass); };
    Table table{
        .title = "The paper's settings",
        .note = fmt::format("{} VPLs, {}x{} maps, {} points each, compute splats with the paper's pull-push, "
                            "blocks of {}x{}, {}x{} pixels; the paper's scene is Sponza, 70K faces.",
                            settings.vpls, settings.ism_size, settings.ism_size, settings.ism_points,
                            settings.interleave, settings.interleave, settings.width, settings.height),
        .columns = {{"part", ""}, {"here", "ms"}, {"paper, GeForce 8800 GTX", "ms"}},
        .rows = {}};
    const auto add = [&](const char* name, const Samples& time, Cell paper) {
        table.rows.push_back({name, time.ms.empty() ? Cell{} : Cell{time.best()}, std::move(paper)});
    };
    add("RSM and choice of VPLs", measured.sum(rsm), 7.0);
    add("creating the ISMs", measured.sum(splat), 44.0);
    add("pull-push", measured.sum(pull_push), 8.0);
    add("gather", measured.part(Part::gather), 15.0);
    add("near field (not in the paper)", measured.sum(near), {});
    add("blur", measured.sum(blur), 4.0);
    add("direct light, G-buffer, composite", measured.part(Part::direct), 11.0);
    add("sum of the parts", measured.sum([](const MeasuredPass&) { return true; }), 89.0);
    report.tables.push_back(std::move(table));
}

}  // namespace

void measure_ism_scaling(const BenchInputs& inputs, BenchReport& report) {
    const std::vector<Sweep> sweeps = {
        {"VPLs", inputs.values<int>({128, 256, 512, 1024, 2048, 4096}),
         [](Settings& settings, int value) { settings.vpls = value; }},
        {"points a map", inputs.values<int>({1024, 2048, 4096, 8192, 16384, 32768}),
         [](Settings& settings, int value) { settings.ism_points = value; }},
        {"map size", inputs.values<int>({32, 64, 128, 256}),
         [](Settings& settings, int value) { settings.ism_size = value; }},
    };
    size_t steps = 3;
    for (const Sweep& sweep : sweeps) {
        steps += sweep.values.size();
    }
    FrameBench bench = inputs.bench(inputs.scene);
    Progress progress("bench ism-fig9", static_cast<int>(steps));
    // Points stay what they are by themselves while maps grow.
    const MeasuredFrame usual = bench.measure(inputs.settings(), 1, Measure::passes);
    BenchOptions fixed = inputs.options;
    fixed.points = usual.report.points_a_map;
    const BenchInputs with_points{inputs.scene, fixed, inputs.timing, inputs.interrupts, inputs.scenes};
    change_setting(report, "points a map", std::to_string(*fixed.points));

    Plot frames{.title = "Time of a frame",
                .note = "One parameter varied at a time, in multiples of its first value.",
                .kind = Plot::Kind::lines,
                .x_label = "multiple of the parameter's first value",
                .y_label = "milliseconds a frame",
                .x_log = true,
                .y_log = true,
                .series = {},
                .bar_names = {}};
    for (const Sweep& sweep : sweeps) {
        add_sweep(with_points, bench, progress, sweep, report, frames);
    }
    report.plots.insert(report.plots.begin(), std::move(frames));
    add_triangles(with_points, bench, progress, report);
    add_paper_breakdown(inputs, bench, progress, report);
    report.paper = {
        fmt::format(
            "{}, Figure 9: frame rate of Sponza against VPLs, points and map size, one varied at a time. Its "
            "text gives no values but one frame's parts, which stand in the table above.",
            k_paper_machine),
        "\"The number of points used has a direct influence on the amount of time it takes to create the "
        "ISMs ... "
        "Increasing the resolution of the shadow maps has little impact on rendering performance.\"",
        "\"An increase in scene tessellation does not increase the cost to compute indirect illumination, "
        "which is "
        "decoupled through the use of a point representation; only the cost of direct illumination "
        "increases.\""};
}

}  // namespace bounce::bench
