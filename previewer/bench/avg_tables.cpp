// SPDX-License-Identifier: Apache-2.0
//
// Tables I and II of Bashford-Rogers et al. 2012, "Approximate Visibility Grids for Interactive Indirect
// Illumination": time of each stage against the scene's triangles, and frames a second against the screen.
#include <fmt/format.h>

#include "bench/experiments.h"
#include "bench/room.h"
#include "renderer/presets.h"
#include "renderer/setting_names.h"

namespace bounce::bench {
namespace {

constexpr std::string_view k_avg_paper_machine =
    "Bashford-Rogers et al. 2012 (3 GHz Q6850 CPU, NVIDIA GeForce 8800 GTX)";

// The paper's Table I, 1024x768 pixels: milliseconds, and frames a second without and with visibility. Rooms
// that are made for it have nearly as many triangles: 12 segments^2 + 24 for even segments.
struct PaperScene {
    const char* name;
    int triangles;
    double vox, trace, maps, rest, fps_none, fps;
    int segments;
};
constexpr PaperScene k_paper_scenes[] = {{"U Room", 156, 0.4, 1.8, 19.9, 19.1, 62.1, 22.3, 4},
                                         {"Elephant", 2113, 1.4, 1.9, 28.6, 19.7, 61.8, 21.1, 14},
                                         {"Office", 28218, 2.2, 2.3, 112.3, 21.4, 23.7, 7.2, 48},
                                         {"Sibenik", 80062, 3.2, 2.2, 80.6, 19.7, 45.5, 9.1, 82}};

struct ScreenSize {
    int width, height;
    double office_fps, sibenik_fps;
};
const std::vector<ScreenSize> k_sizes = {{640, 480, 7.9, 10.2},  {800, 600, 7.5, 9.9},
                                         {1024, 768, 7.2, 8.9},  {1280, 1024, 6.9, 8.1},
                                         {1920, 1080, 6.7, 7.2}, {1920, 1200, 5.5, 6.9}};

Settings preset(const BenchInputs& inputs) {
    Settings settings = preset_settings(Preset::avg2012);
    settings.width = inputs.options.width.value_or(inputs.options.quick ? 160 : 1024);
    settings.height = inputs.options.height.value_or(inputs.options.quick ? 90 : 768);
    if (inputs.options.vpls) {
        // Of all bounces together, as the paper counts them.
        settings.vpls = settings.bounce_vpls = std::max(*inputs.options.vpls / settings.bounces, 1);
    } else if (inputs.options.quick) {
        settings.vpls = settings.bounce_vpls = 16;
    }
    settings.ism_size = inputs.options.ism_size.value_or(inputs.options.quick ? 32 : settings.ism_size);
    settings.interleave = inputs.options.interleave.value_or(settings.interleave);
    return settings;
}

void describe(const BenchInputs& inputs, const Settings& settings, BenchReport& report) {
    report.settings = {
        {"preset", "avg2012"},
        {"frame", fmt::format("{:g}", inputs.frame())},
        {"size", fmt::format("{}x{}", settings.width, settings.height)},
        {"VPLs", fmt::format("{} and {} of each further bounce", settings.vpls, settings.bounce_vpls)},
        {"bounces", std::to_string(settings.bounces)},
        {"grid", std::to_string(settings.avg_size)},
        {"hits", name_of(settings.avg_hits)},
        {"visibility", name_of(settings.visibility)},
        {"map size", std::to_string(settings.ism_size)},
        {"interleave", fmt::format("{0}x{0}", settings.interleave)}};
}

bool fills_grid(const MeasuredPass& pass) {
    return pass.name == "avg cells" || pass.name == "avg voxels" || pass.name == "avg slabs";
}

bool traces(const MeasuredPass& pass) {
    return pass.name.starts_with("avg trace") || pass.name == "avg flux" || pass.name == "vpl spacing";
}

double frames(const MeasuredFrame& measured) {
    return 1e3 / measured.frame.best();
}

Table paper_stages() {
    Table table{
        .title = "The paper's Table I",
        .note = fmt::format("{}; 1024 lights of three bounces, 1024x768 pixels.", k_avg_paper_machine),
        .columns = {{"scene", ""},
                    {"triangles", ""},
                    {"grid", "ms"},
                    {"trace", "ms"},
                    {"shadow maps", "ms"},
                    {"the rest", "ms"},
                    {"without visibility", "frames/s"},
                    {"with visibility", "frames/s"}},
        .rows = {}};
    for (const PaperScene& s : k_paper_scenes) {
        table.rows.push_back(
            {s.name, static_cast<double>(s.triangles), s.vox, s.trace, s.maps, s.rest, s.fps_none, s.fps});
    }
    return table;
}

}  // namespace

void measure_avg_stages(const BenchInputs& inputs, BenchReport& report) {
    const Settings settings = preset(inputs);
    describe(inputs, settings, report);
    Settings open = settings;
    open.visibility = Visibility::none;
    std::vector<scene::Scene> scenes;
    for (const PaperScene& of :
         inputs.values(std::vector<PaperScene>(std::begin(k_paper_scenes), std::end(k_paper_scenes)))) {
        scenes.push_back(make_room(of.segments));
    }
    scenes.push_back(inputs.scene);
    Progress progress("bench avg-table1", static_cast<int>(scenes.size()));
    Table table{
        .title = "Time of each stage against triangles",
        .note =
            "Rooms with spheres of about as many triangles as the paper's scenes, then the scene given. "
            "Grid: filling it; trace: following rays through it and finding the area that each "
            "light stands for; the rest: G-buffer, direct light, gather and blur.",
        .columns = paper_stages().columns,
        .rows = {}};
    Plot plot{.title = "Time of each stage against triangles",
              .note = "Dashed: the paper's, on its own machine and scenes.",
              .kind = Plot::Kind::lines,
              .x_label = "triangles",
              .y_label = "milliseconds",
              .x_log = true,
              .y_log = true,
              .series = {{"grid", {}}, {"trace", {}}, {"shadow maps", {}}, {"the rest", {}}},
              .bar_names = {}};
    for (size_t i = 0; i < scenes.size(); ++i) {
        const scene::Scene& scene = scenes[i];
        FrameBench bench(scene, i + 1 == scenes.size() ? inputs.frame() : 1.0,
                         i + 1 == scenes.size() ? inputs.options.camera : std::string(), inputs.timing,
                         inputs.interrupts);
        const MeasuredFrame measured = bench.measure(settings, inputs.repeat());
        const MeasuredFrame without = bench.measure(open, inputs.repeat());
        const double stages[4] = {
            measured.sum(fills_grid).best(), measured.sum(traces).best(), measured.part(Part::maps).best(),
            measured
                .sum([](const MeasuredPass& pass) {
                    return !fills_grid(pass) && !traces(pass) && pass.part != Part::maps;
                })
                .best()};
        const auto triangles = static_cast<double>(measured.report.triangles);
        table.rows.push_back({scene.name, triangles, stages[0], stages[1], stages[2], stages[3],
                              frames(without), frames(measured)});
        for (size_t k = 0; k < 4 && i + 1 < scenes.size(); ++k) {
            plot.series[k].points.push_back({triangles, stages[k]});
        }
        progress.step(fmt::format("{:.0f} triangles: {:.1f} ms", triangles, measured.frame.best()));
    }
    const char* names[] = {"paper, grid", "paper, trace", "paper, shadow maps", "paper, the rest"};
    for (size_t k = 0; k < 4; ++k) {
        Series series{names[k], {}, true};
        for (const PaperScene& s : k_paper_scenes) {
            const double times[4] = {s.vox, s.trace, s.maps, s.rest};
            series.points.push_back({static_cast<double>(s.triangles), times[k]});
        }
        plot.series.push_back(std::move(series));
    }
    report.tables = {std::move(table), paper_stages()};
    report.plots.push_back(std::move(plot));
    report.paper = {
        fmt::format("\"the times for the voxelisation stage (the construction of the AVG) are in the "
                    "order of a couple of milliseconds for moderately complicated scenes.\" ({})",
                    k_avg_paper_machine)};
}

void measure_avg_screens(const BenchInputs& inputs, BenchReport& report) {
    Settings settings = preset(inputs);
    describe(inputs, settings, report);
    change_setting(report, "size", "varied");
    std::vector<ScreenSize> sizes = inputs.values(k_sizes);
    FrameBench bench = inputs.bench(inputs.scene);
    Progress progress("bench avg-table2", static_cast<int>(sizes.size()));
    Table table{
        .title = "Frames a second against screen size",
        .note = fmt::format("Paper: {}. Over the first: how many times as many frames as on its smallest "
                            "screen.",
                            k_avg_paper_machine),
        .columns = {{"screen", ""},
                    {"ours", "frames/s"},
                    {"paper, Office", "frames/s"},
                    {"paper, Sibenik", "frames/s"},
                    {"ours over the first", "times"},
                    {"Office over the first", "times"},
                    {"Sibenik over the first", "times"}},
        .rows = {}};
    Plot plot{.title = "Frames a second against screen size",
              .note = "Dashed: the paper's, on its own machine and scenes.",
              .kind = Plot::Kind::lines,
              .x_label = "million pixels",
              .y_label = "frames a second",
              .x_log = false,
              .y_log = true,
              .series = {{"ours", {}}, {"paper, Office", {}, true}, {"paper, Sibenik", {}, true}},
              .bar_names = {}};
    double first = 0.0;
    for (const ScreenSize& size : sizes) {
        const int divisor = inputs.options.quick ? 8 : 1;
        settings.width = size.width / divisor;
        settings.height = size.height / divisor;
        const double rate = frames(bench.measure(settings, inputs.repeat()));
        first = first > 0.0 ? first : rate;
        const std::string name = fmt::format("{}x{}", settings.width, settings.height);
        table.rows.push_back({name, rate, size.office_fps, size.sibenik_fps, rate / first,
                              size.office_fps / k_sizes[0].office_fps,
                              size.sibenik_fps / k_sizes[0].sibenik_fps});
        const double pixels = settings.width * settings.height * 1e-6;
        plot.series[0].points.push_back({pixels, rate});
        plot.series[1].points.push_back({size.width * size.height * 1e-6, size.office_fps});
        plot.series[2].points.push_back({size.width * size.height * 1e-6, size.sibenik_fps});
        progress.step(fmt::format("{}: {:.1f} ms", name, 1e3 / rate));
    }
    report.tables.push_back(std::move(table));
    report.plots.push_back(std::move(plot));
}

}  // namespace bounce::bench
