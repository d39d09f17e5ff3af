// SPDX-License-Identifier: Apache-2.0
//
// What it takes to make the maps: imperfect ones from points, classic ones from triangles.
#include <algorithm>

#include <fmt/format.h>

#include "bench/experiments.h"
#include "scene/refine.h"

namespace bounce::bench {
namespace {

constexpr double k_least_speedup = 30.0;

struct MapMaker {
    const char* name;
    Splat splat;
    PullPush pull_push;
};

// The scene with its triangles split until a frame draws at least so many.
scene::Scene with_triangles(const BenchInputs& inputs, size_t own, size_t least) {
    scene::Scene scene = inputs.scene;
    double factor = static_cast<double>(least) / static_cast<double>(std::max<size_t>(own, 1));
    // A mesh drawn several times counts as often, so the first try may miss by a few.
    while (own > 0 && drawn_triangles(scene, inputs.frame()) < least) {
        scene = inputs.scene;
        scene::refine_scene(scene, scene::refinement_by(factor));
        factor *= 1.001;
    }
    return scene;
}

}  // namespace

void measure_ism_creation(const BenchInputs& inputs, BenchReport& report) {
    const std::vector<int> sizes = inputs.options.ism_size ? std::vector<int>{*inputs.options.ism_size}
                                                           : inputs.values<int>({64, 128, 256});
    const std::vector<MapMaker> makers = {{"compute splats, pull-push", Splat::compute, PullPush::fill},
                                          {"disks", Splat::disks, PullPush::off},
                                          {"GL_POINTS, pull-push", Splat::points, PullPush::fill}};
    const size_t own = drawn_triangles(inputs.scene, inputs.frame());
    const scene::Scene scene =
        with_triangles(inputs, own, static_cast<size_t>(inputs.options.least_triangles));
    Settings settings = inputs.settings();
    // Only the maps are timed.
    settings.width = inputs.options.width.value_or(64);
    settings.height = inputs.options.height.value_or(36);
    change_setting(report, "size", fmt::format("{}x{}", settings.width, settings.height));
    change_setting(report, "map size", "varied");
    change_setting(report, "splat", "varied");
    FrameBench bench = inputs.bench(scene);
    Progress progress("bench ism-creation", static_cast<int>(sizes.size() * (makers.size() + 1)));

    Table table{.title = "Making the maps",
                .note = "",
                .columns = {{"map size", ""},
                            {"maps", ""},
                            {"points a map", ""},
                            {"time", "ms"},
                            {"median", "ms"},
                            {"classic over this", "times"}},
                .rows = {}};
    Plot plot{.title = "Time to make the maps",
              .note = "",
              .kind = Plot::Kind::lines,
              .x_label = "texels a side of a map",
              .y_label = "milliseconds",
              .x_log = true,
              .y_log = true,
              .series = {{"classic, from triangles", {}}},
              .bar_names = {}};
    for (const MapMaker& maker : makers) {
        plot.series.push_back({maker.name, {}});
    }
    size_t triangles = 0;
    for (const int size : sizes) {
        settings.ism_size = size;
        settings.visibility = Visibility::shadow_maps;
        settings.splat = Splat::disks;
        const MeasuredFrame classic = bench.measure(settings, inputs.repeat(), Measure::passes);
        const Samples classic_time = classic.part(Part::maps);
        triangles = classic.report.triangles;
        const auto x = static_cast<double>(size);
        table.rows.push_back(
            {x, "classic, from triangles", {}, classic_time.best(), classic_time.median(), {}});
        plot.series[0].points.push_back({x, classic_time.best()});
        progress.step(fmt::format("classic, {} texels: {:.1f} ms", size, classic_time.best()));
        settings.visibility = Visibility::ism;
        for (size_t i = 0; i < makers.size(); ++i) {
            settings.splat = makers[i].splat;
            settings.pull_push = makers[i].pull_push;
            const MeasuredFrame measured = bench.measure(settings, inputs.repeat(), Measure::passes);
            const Samples time = measured.part(Part::maps);
            const double ratio = classic_time.best() / time.best();
            table.rows.push_back({x, makers[i].name, static_cast<double>(measured.report.points_a_map),
                                  time.best(), time.median(), ratio});
            plot.series[i + 1].points.push_back({x, time.best()});
            progress.step(fmt::format("{}, {} texels: {:.1f} ms", makers[i].name, size, time.best()));
            if (makers[i].splat != Splat::points) {
                report.checks.push_back({fmt::format("{} maps of {}x{}, {}: speed over classic maps",
                                                     settings.vpls, size, size, makers[i].name),
                                         ratio, Check::Kind::at_least, k_least_speedup, "times"});
            }
        }
    }
    table.note = fmt::format(
        "{} maps, {} triangles{}. Times include pull-push, large triangles and clearing.", settings.vpls,
        triangles, triangles > own ? fmt::format(" (split from {} without moving the surface)", own) : "");
    plot.note = table.note;
    report.tables.push_back(std::move(table));
    report.plots.push_back(std::move(plot));
    report.paper = {
        fmt::format("{}, Sponza, 70K faces, 256 VPLs, maps of 256x256: \"ISMs can be created more than 30 "
                    "times faster for this particular scene, even with pull-push.\"",
                    k_paper_machine)};
}

}  // namespace bounce::bench
