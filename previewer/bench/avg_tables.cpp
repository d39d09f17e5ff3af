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

// The paper's screens are divided by this: a software driver takes seconds for a picture of a million pixels.
int screen_divisor(const BenchInputs& inputs) {
    if (inputs.options.screen_divisor) {
        return *inputs.options.screen_divisor;
    }
    return inputs.options.quick ? 8 : inputs.timing == gl::TimingMode::finish ? 2 : 1;
}

std::string divisor_sentence(const BenchInputs& inputs) {
    const int divisor = screen_divisor(inputs);
    return divisor == 1
               ? "Screens as the paper's."
               : fmt::format("Ours are 1/{} of the paper's screens each way (--screen-divisor).", divisor);
}

Settings preset(const BenchInputs& inputs) {
    Settings settings = preset_settings(Preset::avg2012);
    settings.width = inputs.options.width.value_or(1024 / screen_divisor(inputs));
    settings.height = inputs.options.height.value_or(768 / screen_divisor(inputs));
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
        {"map projection", name_of(settings.map_projection)},
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
    struct Row {
        std::string name;
        scene::Scene scene;
        Settings settings;
        bool plotted = true;
        bool own_frame = false;
    };
    std::vector<Row> rows;
    for (const PaperScene& of :
         inputs.values(std::vector<PaperScene>(std::begin(k_paper_scenes), std::end(k_paper_scenes)))) {
        rows.push_back({fmt::format("room, as {}", of.name), make_room(of.segments), settings});
    }
    // The paper draws Sibenik's maps from 7,000 triangles.
    Settings simplified = settings;
    simplified.visibility = Visibility::simplified;
    rows.push_back({rows.back().name + ", maps simplified", rows.back().scene, simplified, false});
    if (!inputs.options.generated) {
        rows.push_back({inputs.scene.name, inputs.scene, settings, false, true});
    }
    Progress progress("bench avg-table1", static_cast<int>(rows.size()));
    Table table{
        .title = "Time of each stage against triangles",
        .note = fmt::format(
            "Rooms with spheres of about as many triangles as the paper's scenes, the last one again with "
            "maps of simplified meshes, then a scene where one is given. {} pixels. {} "
            "Grid: filling it; trace: following rays through it and finding the area that each "
            "light stands for; the rest: G-buffer, direct light, gather and blur.",
            fmt::format("{}x{}", settings.width, settings.height), divisor_sentence(inputs)),
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
    for (const Row& row : rows) {
        FrameBench bench(row.scene, row.own_frame ? inputs.frame() : 1.0,
                         row.own_frame ? inputs.options.camera : std::string(), inputs.timing,
                         inputs.interrupts);
        const MeasuredFrame measured = bench.measure(row.settings, inputs.repeat());
        Settings open = row.settings;
        open.visibility = Visibility::none;
        const MeasuredFrame without = bench.measure(open, inputs.repeat());
        const double stages[4] = {
            measured.sum(fills_grid).best(), measured.sum(traces).best(), measured.part(Part::maps).best(),
            measured
                .sum([](const MeasuredPass& pass) {
                    return !fills_grid(pass) && !traces(pass) && pass.part != Part::maps;
                })
                .best()};
        const auto triangles = static_cast<double>(measured.report.triangles);
        table.rows.push_back({row.name, triangles, stages[0], stages[1], stages[2], stages[3],
                              frames(without), frames(measured)});
        for (size_t k = 0; k < 4 && row.plotted; ++k) {
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
    const std::vector<ScreenSize> sizes = inputs.values(k_sizes);
    const int divisor = screen_divisor(inputs);
    std::vector<std::pair<std::string, scene::Scene>> scenes;
    if (inputs.options.generated) {
        scenes.emplace_back("room, as Office", make_room(k_paper_scenes[2].segments));
        scenes.emplace_back("room, as Sibenik", make_room(k_paper_scenes[3].segments));
    } else {
        scenes.emplace_back(inputs.scene.name, inputs.scene);
    }
    Progress progress("bench avg-table2", static_cast<int>(scenes.size() * sizes.size()));
    Table table{.title = "Frames a second against screen size",
                .note = fmt::format(
                    "Paper: {}. {} Rooms with spheres have about as many triangles as the paper's scenes. "
                    "Over the first: how many times as many frames as on its smallest screen.",
                    k_avg_paper_machine, divisor_sentence(inputs)),
                .columns = {{"paper's screen", ""}, {"screen", ""}},
                .rows = {}};
    Plot plot{.title = "Frames a second against screen size",
              .note = "Dashed: the paper's, on its own machine, scenes and screens.",
              .kind = Plot::Kind::lines,
              .x_label = "million pixels of the paper's screen",
              .y_label = "frames a second",
              .x_log = false,
              .y_log = true,
              .series = {},
              .bar_names = {}};
    for (const ScreenSize& size : sizes) {
        table.rows.push_back({fmt::format("{}x{}", size.width, size.height),
                              fmt::format("{}x{}", size.width / divisor, size.height / divisor)});
    }
    // A column of frames a second and one of how many times as many as in its first row.
    const auto add_columns = [&](const std::string& name, const std::vector<double>& rates, bool from_paper) {
        table.columns.push_back({name, "frames/s"});
        table.columns.push_back({name + ", over the first", "times"});
        Series series{name, {}, from_paper};
        for (size_t i = 0; i < sizes.size(); ++i) {
            table.rows[i].emplace_back(rates[i]);
            table.rows[i].emplace_back(rates[i] / rates.front());
            series.points.push_back({sizes[i].width * sizes[i].height * 1e-6, rates[i]});
        }
        plot.series.push_back(std::move(series));
    };
    for (const auto& [name, scene] : scenes) {
        FrameBench bench = inputs.bench(scene);
        std::vector<double> rates;
        for (const ScreenSize& size : sizes) {
            settings.width = size.width / divisor;
            settings.height = size.height / divisor;
            rates.push_back(frames(bench.measure(settings, inputs.repeat(), Measure::frame)));
            progress.step(fmt::format("{}, {}x{}: {:.1f} ms", name, settings.width, settings.height,
                                      1e3 / rates.back()));
        }
        add_columns(name, rates, false);
    }
    std::vector<double> office;
    std::vector<double> sibenik;
    for (const ScreenSize& size : sizes) {
        office.push_back(size.office_fps);
        sibenik.push_back(size.sibenik_fps);
    }
    add_columns("paper, Office", office, true);
    add_columns("paper, Sibenik", sibenik, true);
    report.tables.push_back(std::move(table));
    report.plots.push_back(std::move(plot));
}

}  // namespace bounce::bench
