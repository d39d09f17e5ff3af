// SPDX-License-Identifier: Apache-2.0
//
// Table I and Figures 6 and 7 of Lv et al. 2009, "A Fast Method for Real-time Computation of Approximated
// Global Illumination": frames a second over the size of the maps and by both of its ways to shade, and how
// far the picture depends on that size and on the number of lights.
#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "bench/experiments.h"
#include "gl/texture.h"
#include "image/metrics.h"
#include "renderer/ism_layout.h"
#include "renderer/presets.h"
#include "renderer/setting_names.h"

namespace bounce::bench {
namespace {

constexpr std::string_view k_lv_paper_machine = "Lv et al. 2009 (2.4 GHz CPU, NVIDIA GeForce GTX 280)";
constexpr int k_paper_side = 800;       // of its screen
constexpr int k_paper_light_map = 512;  // of Figure 7
constexpr int k_exact_map = 512;        // of the maps that Figure 6's are compared with
constexpr int k_many_lights = 4096;     // that Figure 7's are compared with
constexpr int k_many_lights_map = 256;
// What this experiment will take of memory for one atlas; drivers hold larger ones, machines often do not.
constexpr double k_most_atlas_gib = 1.0;

struct PaperRange {
    double low = 0.0;
    double high = 0.0;
    [[nodiscard]] double middle() const { return 0.5 * (low + high); }
};

// The paper's Table I.
struct PaperScene {
    const char* name;
    const char* triangles;
    const char* simplified;
    PaperRange hybrid[3];  // of maps of 256, 512 and 1024
    PaperRange deferred[3];
};
constexpr PaperScene k_paper_scenes[] = {
    {"sphere", "3.4K", "as they are", {{27, 35}, {22, 29}, {11, 13}}, {{18, 22}, {15, 18}, {8, 9}}},
    {"torus knot", "4.4K", "as they are", {{30, 35}, {21, 26}, {10, 12}}, {{18, 21}, {15, 18}, {8, 9}}},
    {"Beethoven", "120K", "8.9K", {{25, 28}, {20, 24}, {10, 11}}, {{17, 19}, {14, 16}, {8, 9}}},
    {"furniture", "60K", "3.4K", {{29, 37}, {22, 28}, {10, 12}}, {{17, 21}, {14, 17}, {8, 9}}}};
constexpr int k_paper_sizes[] = {256, 512, 1024};

Settings preset(const BenchInputs& inputs, bool paper_screen) {
    Settings settings = preset_settings(Preset::lv2009);
    const Settings given = inputs.settings();
    const bool as_paper = paper_screen && !inputs.options.width && !inputs.options.quick;
    settings.width = as_paper ? k_paper_side : given.width;
    settings.height = as_paper ? k_paper_side : given.height;
    settings.vpls = inputs.options.vpls.value_or(inputs.options.quick ? 16 : settings.vpls);
    settings.ism_size = inputs.options.ism_size.value_or(inputs.options.quick ? 32 : settings.ism_size);
    settings.interleave = inputs.options.interleave.value_or(settings.interleave);
    return settings;
}

void describe(const BenchInputs& inputs, const Settings& settings, BenchReport& report) {
    report.settings = {{"preset", "lv2009"},
                       {"frame", fmt::format("{:g}", inputs.frame())},
                       {"size", fmt::format("{}x{}", settings.width, settings.height)},
                       {"VPLs", std::to_string(settings.vpls)},
                       {"map size", std::to_string(settings.ism_size)},
                       {"shading", name_of(settings.shading)},
                       {"interleave", fmt::format("{0}x{0}", settings.interleave)},
                       {"bounces", std::to_string(settings.bounces)}};
}

// Measured, or the reason why not, which is noted.
std::optional<MeasuredFrame> measure(const BenchInputs& inputs, FrameBench& bench, const Settings& settings,
                                     BenchReport& report) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    if (const std::string reason = maps_too_large(settings, most); !reason.empty()) {
        report.notes.push_back(fmt::format("Not measured: {}.", reason));
        return std::nullopt;
    }
    return bench.measure(settings, inputs.repeat());
}

double frames(const MeasuredFrame& measured) {
    return 1e3 / measured.frame.best();
}

Cell frames_cell(const std::optional<MeasuredFrame>& measured) {
    return measured ? Cell{frames(*measured)} : Cell{"not measured"};
}

Cell ratio_cell(const std::optional<MeasuredFrame>& measured, const std::optional<MeasuredFrame>& first) {
    return measured && first ? Cell{frames(*measured) / frames(*first)} : Cell{};
}

Table paper_table() {
    Table table{.title = "The paper's Table I",
                .note = fmt::format("{}, 256 lights, 800x800 pixels; frames a second, and their middle over "
                                    "that at maps of 256.",
                                    k_lv_paper_machine),
                .columns = {{"scene", ""},
                            {"triangles", ""},
                            {"simplified", ""},
                            {"map size", ""},
                            {"hybrid", "frames/s"},
                            {"deferred", "frames/s"},
                            {"hybrid over 256", "times"},
                            {"deferred over 256", "times"}},
                .rows = {}};
    const auto range = [](const PaperRange& r) { return fmt::format("{:g} to {:g}", r.low, r.high); };
    for (const PaperScene& scene : k_paper_scenes) {
        for (size_t i = 0; i < std::size(k_paper_sizes); ++i) {
            table.rows.push_back({scene.name, scene.triangles, scene.simplified,
                                  static_cast<double>(k_paper_sizes[i]), range(scene.hybrid[i]),
                                  range(scene.deferred[i]),
                                  scene.hybrid[i].middle() / scene.hybrid[0].middle(),
                                  scene.deferred[i].middle() / scene.deferred[0].middle()});
        }
    }
    return table;
}

Plot line_plot(const std::string& title, const std::string& note, const std::string& x,
               const std::string& y) {
    return {.title = title,
            .note = note,
            .kind = Plot::Kind::lines,
            .x_label = x,
            .y_label = y,
            .x_log = true,
            .y_log = true,
            .series = {},
            .bar_names = {}};
}

// Of the light that bounces, in percent.
struct Error {
    double nrmse = 0.0;
    double bias = 0.0;
};
Error error(const Image& image, const Image& reference) {
    const Metrics metrics = compare(image, reference, HdrFlip::leave_out);
    return {100.0 * metrics.nrmse, 100.0 * metrics.bias};
}

}  // namespace

std::string maps_too_large(const Settings& settings, int texture_size) {
    const IsmLayout layout = ism_layout(settings, 1, 0);
    const double gib =
        4.0 * static_cast<double>(layout.atlas_width()) * layout.atlas_height() / (1024.0 * 1024.0 * 1024.0);
    const std::string atlas =
        fmt::format("{0} maps of {1}x{1} texels make an atlas of {2}x{3}, {4:.2g} GiB", layout.vpls,
                    settings.ism_size, layout.atlas_width(), layout.atlas_height(), gib);
    if (layout.atlas_width() > texture_size || layout.atlas_height() > texture_size) {
        return fmt::format("{}; this OpenGL driver holds {} texels a side", atlas, texture_size);
    }
    return gib > k_most_atlas_gib
               ? fmt::format("{}; this experiment takes no more than {:g}", atlas, k_most_atlas_gib)
               : std::string();
}

void measure_simplified_maps(const BenchInputs& inputs, BenchReport& report) {
    Settings settings = preset(inputs, true);
    describe(inputs, settings, report);
    change_setting(report, "map size", "varied");
    change_setting(report, "shading", "varied");
    const std::vector<int> sizes = inputs.options.quick
                                       ? std::vector<int>{32, 64}
                                       : std::vector<int>(std::begin(k_paper_sizes), std::end(k_paper_sizes));
    FrameBench bench = inputs.bench(inputs.scene);
    Progress progress("bench lv-table1", static_cast<int>(3 * sizes.size()));
    Table table{.title = "Frames a second by shading and map size",
                .note = "",
                .columns = {{"map size", ""},
                            {"hybrid", "frames/s"},
                            {"deferred", "frames/s"},
                            {"deferred, whole meshes", "frames/s"},
                            {"hybrid over 256", "times"},
                            {"deferred over 256", "times"},
                            {"simplified over whole", "times"},
                            {"maps", "ms"},
                            {"maps, whole meshes", "ms"}},
                .rows = {}};
    table.columns[4].name = fmt::format("hybrid over {}", sizes.front());
    table.columns[5].name = fmt::format("deferred over {}", sizes.front());
    Plot plot = line_plot("Frames a second against map size", "Dashed: the paper's, on its own machine.",
                          "texels a side of a map", "frames a second");
    plot.series = {{"hybrid", {}}, {"deferred", {}}, {"deferred, whole meshes", {}}};
    std::optional<MeasuredFrame> first_hybrid;
    std::optional<MeasuredFrame> first_deferred;
    for (const int size : sizes) {
        settings.ism_size = size;
        const auto run = [&](Shading shading, Visibility visibility, size_t series, const char* name) {
            Settings of = settings;
            of.shading = shading;
            of.visibility = visibility;
            std::optional<MeasuredFrame> measured = measure(inputs, bench, of, report);
            if (measured)
                plot.series[series].points.push_back({static_cast<double>(size), frames(*measured)});
            progress.step(measured
                              ? fmt::format("{}, maps of {}: {:.1f} ms", name, size, measured->frame.best())
                              : fmt::format("{}, maps of {}: not measured", name, size));
            return measured;
        };
        const auto hybrid = run(Shading::hybrid, Visibility::simplified, 0, "hybrid");
        const auto deferred = run(Shading::deferred, Visibility::simplified, 1, "deferred");
        const auto whole = run(Shading::deferred, Visibility::shadow_maps, 2, "whole meshes");
        if (size == sizes.front()) {
            first_hybrid = hybrid;
            first_deferred = deferred;
        }
        const auto maps = [](const std::optional<MeasuredFrame>& of) {
            return of ? Cell{of->part(Part::maps).best()} : Cell{};
        };
        table.rows.push_back({static_cast<double>(size), frames_cell(hybrid), frames_cell(deferred),
                              frames_cell(whole), ratio_cell(hybrid, first_hybrid),
                              ratio_cell(deferred, first_deferred), ratio_cell(deferred, whole),
                              maps(deferred), maps(whole)});
        if (deferred) {
            table.note = fmt::format(
                "{} triangles, simplified to {}, which moved the surface by {} mm at most (quadric error).",
                deferred->report.triangles, deferred->report.simplified_triangles,
                format_number(1e3 * deferred->report.simplified_error_m));
        }
    }
    for (const PaperScene& scene : k_paper_scenes) {
        if (inputs.options.quick || scene.simplified[0] == 'a') {
            continue;
        }
        for (const bool hybrid : {true, false}) {
            Series series{fmt::format("paper, {}, {}", scene.name, hybrid ? "hybrid" : "deferred"), {}, true};
            for (size_t i = 0; i < std::size(k_paper_sizes); ++i) {
                series.points.push_back({static_cast<double>(k_paper_sizes[i]),
                                         (hybrid ? scene.hybrid : scene.deferred)[i].middle()});
            }
            plot.series.push_back(std::move(series));
        }
    }
    report.tables = {std::move(table), paper_table()};
    report.plots.push_back(std::move(plot));
    report.paper = {fmt::format(
        "\"From table 1 we can find that the rendering efficiency will greatly decrease from 512x512 to "
        "1024x1024.\" ({})",
        k_lv_paper_machine)};
}

void measure_simplified_map_sizes(const BenchInputs& inputs, BenchReport& report) {
    Settings settings = preset(inputs, false);
    describe(inputs, settings, report);
    change_setting(report, "map size", "varied");
    settings.show = Show::indirect;
    const std::vector<int> sizes =
        inputs.options.quick ? std::vector<int>{32, 64} : std::vector<int>{64, 128, 256, 512, 1024};
    FrameBench bench = inputs.bench(inputs.scene);
    Progress progress("bench lv-fig6", static_cast<int>(sizes.size()) + 1);
    Settings exact = settings;
    exact.visibility = Visibility::shadow_maps;
    exact.map_projection = MapProjection::faces;
    exact.ism_size = inputs.options.quick ? 64 : k_exact_map;
    (void)bench.measure(settings, 1, Measure::passes);  // refuses a scene without bounced light
    const Image reference = bench.picture(exact);
    progress.step("reference");
    Table table{
        .title = "Error and time against map size",
        .note = fmt::format("Bounced light alone, against the same {0} lights with exact maps of whole "
                            "meshes ({1}x{1}, through a cube's faces).",
                            settings.vpls, exact.ism_size),
        .columns = {{"map size", ""},
                    {"NRMSE", "%"},
                    {"bias", "%"},
                    {"NRMSE against the size before", "%"},
                    {"frames", "/s"},
                    {"maps", "ms"}},
        .rows = {}};
    Plot plot = line_plot("Error against map size", table.note, "texels a side of a map", "NRMSE, %");
    plot.series = {{"against exact maps", {}}, {"against the size before", {}}};
    std::optional<Image> before;
    for (const int size : sizes) {
        settings.ism_size = size;
        const std::optional<MeasuredFrame> measured = measure(inputs, bench, settings, report);
        if (!measured) {
            table.rows.push_back({static_cast<double>(size), {}, {}, {}, "not measured", {}});
            progress.step(fmt::format("maps of {}: not measured", size));
            continue;
        }
        Image image = bench.picture(settings);
        const Error off = error(image, reference);
        Cell step;
        if (before) {
            step = error(image, *before).nrmse;
            plot.series[1].points.push_back({static_cast<double>(size), step.number});
        }
        progress.step(
            fmt::format("maps of {}: NRMSE {:.2f} %, {:.1f} ms", size, off.nrmse, measured->frame.best()));
        table.rows.push_back({static_cast<double>(size), off.nrmse, off.bias, step, frames(*measured),
                              measured->part(Part::maps).best()});
        plot.series[0].points.push_back({static_cast<double>(size), off.nrmse});
        before = std::move(image);
    }
    report.tables.push_back(std::move(table));
    report.plots.push_back(std::move(plot));
    report.paper = {
        fmt::format("{}, Figure 6: \"there is no clear improvement in the final image quality while "
                    "the resolution increases from 256x256 to 1024x1024.\"",
                    k_lv_paper_machine)};
}

void measure_pixel_lights(const BenchInputs& inputs, BenchReport& report) {
    Settings settings = preset(inputs, false);
    if (!inputs.options.ism_size && !inputs.options.quick) {
        settings.ism_size = k_paper_light_map;
    }
    describe(inputs, settings, report);
    change_setting(report, "VPLs", "varied");
    settings.show = Show::indirect;
    const std::vector<int> counts =
        inputs.options.quick ? std::vector<int>{16, 32} : std::vector<int>{64, 128, 256, 512, 1024};
    FrameBench bench = inputs.bench(inputs.scene);
    Progress progress("bench lv-fig7", static_cast<int>(counts.size()) + 1);
    Settings many = settings;
    many.vpls = inputs.options.quick ? 64 : k_many_lights;
    many.ism_size = std::min(settings.ism_size, k_many_lights_map);
    (void)bench.measure(settings, 1, Measure::passes);  // refuses a scene without bounced light
    const Image reference = bench.picture(many);
    progress.step("reference");
    Table table{.title = "Error and time against pixel lights",
                .note = fmt::format("Bounced light alone, against {} lights with maps of {}x{}.", many.vpls,
                                    many.ism_size, many.ism_size),
                .columns = {{"lights", ""},
                            {"NRMSE", "%"},
                            {"bias", "%"},
                            {"frames", "/s"},
                            {"over the row before", "times"},
                            {"maps", "ms"},
                            {"gather", "ms"}},
                .rows = {}};
    Plot plot = line_plot("Error and time against pixel lights", table.note, "lights", "NRMSE, %");
    plot.series = {{"NRMSE", {}}};
    std::optional<MeasuredFrame> before;
    for (const int count : counts) {
        settings.vpls = count;
        std::optional<MeasuredFrame> measured = measure(inputs, bench, settings, report);
        if (!measured) {
            table.rows.push_back({static_cast<double>(count), {}, {}, "not measured", {}, {}, {}});
            progress.step(fmt::format("{} lights: not measured", count));
            continue;
        }
        const Error off = error(bench.picture(settings), reference);
        progress.step(
            fmt::format("{} lights: NRMSE {:.2f} %, {:.1f} ms", count, off.nrmse, measured->frame.best()));
        table.rows.push_back({static_cast<double>(count), off.nrmse, off.bias, frames(*measured),
                              ratio_cell(measured, before), measured->part(Part::maps).best(),
                              measured->part(Part::gather).best()});
        plot.series[0].points.push_back({static_cast<double>(count), off.nrmse});
        before = std::move(measured);
    }
    report.tables.push_back(std::move(table));
    report.plots.push_back(std::move(plot));
    report.paper = {
        fmt::format("{}, Figure 7: \"When the number of pixel lights increases to double, the frame "
                    "rate will decreases to almost half of before. According to our test, we can get "
                    "good result with 256 samples.\"",
                    k_lv_paper_machine)};
}

}  // namespace bounce::bench
