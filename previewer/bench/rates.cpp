// SPDX-License-Identifier: Apache-2.0
//
// How fast the two inner loops run, in the frame's own passes, and what of a frame is neither.
#include <algorithm>

#include <fmt/format.h>

#include "bench/experiments.h"

namespace bounce::bench {
namespace {

// Points a map where the path or the map size varies: the paper's 4K.
constexpr int k_points = 4096;
constexpr double k_least_splats = 50.0;    // M points/s
constexpr double k_least_gathers = 100.0;  // M VPL evaluations/s

// The picture of a splat's measurement is of no interest; only its lights' maps are drawn in earnest.
constexpr int k_small_width = 64;
constexpr int k_small_height = 36;

struct SplatRate {
    Samples time;
    double points = 0.0;
    [[nodiscard]] double best() const { return millions_a_second(points, time.best()); }
    [[nodiscard]] double median() const { return millions_a_second(points, time.median()); }
};

class Splats {
  public:
    Splats(const BenchInputs& inputs, FrameBench& bench, Progress& progress)
        : inputs_(inputs), bench_(bench), progress_(progress) {}

    SplatRate measure(Splat splat, int map_size, int points, PullPush pull_push) {
        Settings settings = inputs_.settings();
        settings.width = k_small_width;
        settings.height = k_small_height;
        settings.splat = splat;
        settings.ism_size = map_size;
        settings.ism_points = points;
        settings.pull_push = pull_push;
        settings.large_triangles = false;  // every surface as points: only these are counted
        const MeasuredFrame measured = bench_.measure(settings, inputs_.repeat(), Measure::passes);
        SplatRate rate;
        rate.time = measured.sum([&](const MeasuredPass& pass) {
            return pass.part == Part::maps && (pull_push != PullPush::off || pass.name != "ism pull-push");
        });
        rate.points = static_cast<double>(measured.report.vpls) * measured.report.points_a_map;
        progress_.step(fmt::format("{}, {} texels, {} points: {:.1f} M points/s", splat_name(splat), map_size,
                                   points, rate.best()));
        return rate;
    }

  private:
    const BenchInputs& inputs_;
    FrameBench& bench_;
    Progress& progress_;
};

struct SplatRow {
    Splat splat;
    PullPush pull_push;
    [[nodiscard]] std::string name() const {
        return splat_name(splat) + (pull_push == PullPush::off ? "" : " with pull-push");
    }
};

const std::vector<SplatRow> k_splats = {{Splat::compute, PullPush::off},
                                        {Splat::compute, PullPush::fill},
                                        {Splat::disks, PullPush::off},
                                        {Splat::points, PullPush::off},
                                        {Splat::points, PullPush::fill}};

void splat_tables(const BenchInputs& inputs, FrameBench& bench, Progress& progress, BenchReport& report,
                  const std::vector<int>& sizes, const std::vector<int>& counts) {
    Splats splats(inputs, bench, progress);
    const Settings base = inputs.settings();
    const int points = inputs.options.points.value_or(k_points);
    Table table{
        .title = "Splat rate by path and map size",
        .note = fmt::format("{} maps, {} points a map. Every point handed to a map counts, also one that the "
                            "map drops because it lies behind the light.",
                            base.vpls, points),
        .columns = {{"splat", ""},
                    {"map size", ""},
                    {"time", "ms"},
                    {"rate", "M points/s"},
                    {"median rate", "M points/s"}},
        .rows = {}};
    for (const SplatRow& row : k_splats) {
        for (const int size : sizes) {
            const SplatRate rate = splats.measure(row.splat, size, points, row.pull_push);
            table.rows.push_back(
                {row.name(), static_cast<double>(size), rate.time.best(), rate.best(), rate.median()});
            if (row.splat == Splat::compute && row.pull_push == PullPush::off && size == sizes.front()) {
                report.checks.push_back(
                    {fmt::format("compute splat, {0}x{0} maps, {1} points each", size, points), rate.best(),
                     Check::Kind::at_least, k_least_splats, "M points/s"});
            }
        }
    }
    report.tables.push_back(std::move(table));

    Plot plot{.title = "Splat rate against points a map",
              .note = fmt::format(
                  "{} maps of {}x{} texels. With few points the time is that of clearing and storing "
                  "the maps.",
                  base.vpls, sizes.front(), sizes.front()),
              .kind = Plot::Kind::lines,
              .x_label = "points a map",
              .y_label = "M points/s",
              .x_log = true,
              .y_log = true,
              .series = {},
              .bar_names = {}};
    Table by_count{.title = plot.title,
                   .note = "Best rate, M points/s, without pull-push.",
                   .columns = {{"points a map", ""}},
                   .rows = {}};
    for (const int count : counts) {
        by_count.rows.push_back({static_cast<double>(count)});
    }
    for (const Splat splat : {Splat::compute, Splat::disks, Splat::points}) {
        Series series{splat_name(splat), {}};
        by_count.columns.push_back({splat_name(splat), ""});
        for (size_t i = 0; i < counts.size(); ++i) {
            const SplatRate rate = splats.measure(splat, sizes.front(), counts[i], PullPush::off);
            series.points.push_back({static_cast<double>(counts[i]), rate.best()});
            by_count.rows[i].emplace_back(rate.best());
        }
        plot.series.push_back(std::move(series));
    }
    report.tables.push_back(std::move(by_count));
    report.plots.push_back(std::move(plot));
}

struct GatherRow {
    const char* name;
    bool glossy_and_near;
    Visibility visibility;
};

void gather_table(const BenchInputs& inputs, FrameBench& bench, Progress& progress, BenchReport& report) {
    const Settings base = inputs.settings();
    Table table{
        .title = "Gather rate",
        .note =
            "Pixels times VPLs a pixel, over the time of the gather. As rendered: with glossy lobes and the "
            "near field's share, where scene and settings have them.",
        .columns = {{"gather", ""},
                    {"VPLs a pixel", ""},
                    {"time", "ms"},
                    {"rate", "M evaluations/s"},
                    {"median rate", "M evaluations/s"}},
        .rows = {}};
    for (const GatherRow& row : {GatherRow{"as rendered", true, Visibility::ism},
                                 GatherRow{"as rendered, no visibility", true, Visibility::none},
                                 GatherRow{"diffuse", false, Visibility::ism},
                                 GatherRow{"diffuse, no visibility", false, Visibility::none}}) {
        Settings settings = base;
        settings.glossy_bounces = row.glossy_and_near;
        settings.near_field = row.glossy_and_near;
        settings.visibility = row.visibility;
        const MeasuredFrame measured = bench.measure(settings, inputs.repeat(), Measure::passes);
        const Samples time = measured.part(Part::gather);
        const double vpls = static_cast<double>(measured.report.vpls) / (base.interleave * base.interleave);
        const double evaluations = vpls * base.width * base.height;
        const double best = millions_a_second(evaluations, time.best());
        table.rows.push_back(
            {row.name, vpls, time.best(), best, millions_a_second(evaluations, time.median())});
        progress.step(fmt::format("gather {}: {:.1f} M evaluations/s", row.name, best));
        if (row.visibility == Visibility::ism) {
            report.checks.push_back({fmt::format("gather {}, with visibility", row.name), best,
                                     Check::Kind::at_least, k_least_gathers, "M evaluations/s"});
        }
    }
    report.tables.push_back(std::move(table));
}

// A bar for each pass, coloured by its part.
Plot pass_plot(const MeasuredFrame& measured) {
    Plot plot{.title = "Where a frame's time goes",
              .note = "Median time of each pass, timed by itself.",
              .kind = Plot::Kind::stacked,
              .x_label = "",
              .y_label = "milliseconds",
              .x_log = false,
              .y_log = false,
              .series = {},
              .bar_names = {}};
    for (int part = 0; part < k_parts; ++part) {
        Series series{part_name(static_cast<Part>(part)), {}};
        for (size_t i = 0; i < measured.passes.size(); ++i) {
            if (measured.passes[i].part == static_cast<Part>(part)) {
                series.points.push_back({static_cast<double>(i), measured.passes[i].time.median()});
            }
        }
        plot.series.push_back(std::move(series));
    }
    for (const MeasuredPass& pass : measured.passes) {
        plot.bar_names.push_back(pass.name);
    }
    return plot;
}

void frame_table(const BenchInputs& inputs, FrameBench& bench, Progress& progress, BenchReport& report) {
    const MeasuredFrame measured = bench.measure(inputs.settings(), inputs.repeat());
    progress.step(fmt::format("frame: {:.1f} ms", measured.frame.best()));
    Table table{
        .title = "Where a frame's time goes",
        .note =
            "Share of the whole frame in which the passes were timed. Outside passes: uploads and set-up on "
            "the CPU.",
        .columns = {{"pass", ""}, {"part", ""}, {"time", "ms"}, {"median", "ms"}, {"share", "%"}},
        .rows = {}};
    // Medians, so that the parts are of one and the same frame as near as can be.
    const double whole = measured.timed_frame.median();
    const auto share = [&](double ms) { return 100.0 * ms / whole; };
    double inside = 0.0;
    for (const MeasuredPass& pass : measured.passes) {
        const double median = pass.time.median();
        inside += median;
        table.rows.push_back({pass.name, part_name(pass.part), pass.time.best(), median, share(median)});
    }
    table.rows.push_back({"outside passes", "", {}, whole - inside, share(whole - inside)});
    const double splat = measured.part(Part::maps).median();
    const double gather = measured.part(Part::gather).median();
    table.rows.push_back({"whole frame", "", measured.timed_frame.best(), whole, 100.0});
    table.rows.push_back(
        {"neither splat nor gather", "", {}, whole - splat - gather, share(whole - splat - gather)});
    report.tables.push_back(std::move(table));
    report.plots.push_back(pass_plot(measured));
    report.notes.push_back(
        fmt::format("A frame without per-pass timing takes {} ms (median {} ms). Of the timed one splats "
                    "take {} %, the gather {} "
                    "%, and {} % is neither.",
                    format_number(measured.frame.best()), format_number(measured.frame.median()),
                    format_number(share(splat)), format_number(share(gather)),
                    format_number(share(whole - splat - gather))));
    report.notes.push_back(fmt::format("{} triangles; {} points in each of {} maps, and {} large triangles.",
                                       measured.report.triangles, measured.report.points_a_map,
                                       measured.report.vpls, measured.report.large_triangles));
}

}  // namespace

void measure_rates(const BenchInputs& inputs, BenchReport& report) {
    const int own_size = inputs.settings().ism_size;
    std::vector<int> sizes = {own_size};
    for (const int size : {64, 128, 256}) {
        if (size != own_size) sizes.push_back(size);
    }
    if (inputs.options.quick) sizes.resize(1);
    const std::vector<int> counts = inputs.values<int>({512, 1024, 2048, 4096, 8192, 16384, 32768});
    FrameBench bench = inputs.bench(inputs.scene);
    Progress progress("bench rates",
                      static_cast<int>(k_splats.size() * sizes.size() + 3 * counts.size()) + 5);
    frame_table(inputs, bench, progress, report);
    gather_table(inputs, bench, progress, report);
    splat_tables(inputs, bench, progress, report, sizes, counts);
    report.paper.push_back(
        fmt::format("{}, Sponza, 1024 ISMs of 256x256 with 8K points: 44 ms to create them, which is 191 M "
                    "points/s; 15 ms to "
                    "gather 16 VPLs a pixel at 640x480, which is 328 M evaluations/s.",
                    k_paper_machine));
}

}  // namespace bounce::bench
