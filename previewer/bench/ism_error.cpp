// SPDX-License-Identifier: Apache-2.0
//
// Figure 4 of the paper: how far light by imperfect shadow maps is from light by true ones.
#include <algorithm>

#include <fmt/format.h>

#include "bench/experiments.h"
#include "image/metrics.h"

namespace bounce::bench {
namespace {

constexpr int k_paper_vpls = 512;
constexpr int k_reference_size = 256;  // of the paper's "GPU reference"
// An error may rise by so much from one point of a curve to the next before it counts as rising: points are
// drawn anew for every count, and a curve that has reached its floor moves up and down by chance.
constexpr double k_tolerated_rise = 1.02;

// Errors of one splat path by map size, then by count.
using Errors = std::vector<std::vector<double>>;

int rises(const std::vector<double>& falling) {
    int count = 0;
    for (size_t i = 0; i + 1 < falling.size(); ++i) {
        // A NaN counts as a rise.
        count += falling[i + 1] <= falling[i] * k_tolerated_rise ? 0 : 1;
    }
    return count;
}

void add_checks(const Errors& errors, const std::string& splat, BenchReport& report) {
    int over_points = 0;
    int over_sizes = 0;
    for (const auto& of_size : errors) {
        over_points += rises(of_size);
    }
    for (size_t i = 0; i < errors.front().size(); ++i) {
        std::vector<double> of_count;
        for (const auto& of_size : errors) {
            of_count.push_back(of_size[i]);
        }
        over_sizes += rises(of_count);
    }
    report.checks.push_back({splat + ": steps to more points where the error rises by more than 2 %",
                             static_cast<double>(over_points), Check::Kind::at_most, 0.0, "steps"});
    report.checks.push_back({splat + ": steps to larger maps where it does", static_cast<double>(over_sizes),
                             Check::Kind::at_most, 0.0, "steps"});
}

}  // namespace

void measure_ism_error(const BenchInputs& inputs, BenchReport& report) {
    const std::vector<int> sizes = inputs.values<int>({64, 128, 256});
    const std::vector<int> counts = inputs.values<int>({1024, 2048, 4096, 8192, 16384, 32768});
    const std::vector<Splat> splats = inputs.options.splat ? std::vector<Splat>{*inputs.options.splat}
                                                           : std::vector<Splat>{Splat::disks, Splat::compute};
    Settings base = inputs.settings();
    base.vpls = inputs.options.vpls.value_or(inputs.options.quick ? base.vpls / 4 : k_paper_vpls);
    base.show = Show::indirect;
    change_setting(report, "VPLs", std::to_string(base.vpls));
    change_setting(report, "map size", "varied");
    change_setting(report, "points a map", "varied");
    if (splats.size() > 1) {
        change_setting(report, "splat", "varied");
    }

    FrameBench bench = inputs.bench(inputs.scene);
    Progress progress("bench ism-fig4", static_cast<int>(splats.size() * sizes.size() * counts.size()) + 4);
    // Refuses a scene without bounced light or without occluders before anything is compared.
    (void)bench.measure(base, 1, Measure::passes);
    const auto draw = [&](Visibility visibility, int size, int points, Splat splat) {
        Settings settings = base;
        settings.visibility = visibility;
        settings.ism_size = size;
        settings.ism_points = points;
        settings.splat = splat;
        return bench.picture(settings);
    };
    const Image reference = draw(Visibility::shadow_maps, k_reference_size, 0, base.splat);
    progress.step("reference");
    const auto compare_with_reference = [&](const Image& image, const std::string& label) {
        const Metrics metrics = compare(image, reference, HdrFlip::leave_out);
        progress.step(fmt::format("{}: NRMSE {:.4f}", label, metrics.nrmse));
        return metrics;
    };

    Table others{.title = "For comparison",
                 .note = "Against the same reference.",
                 .columns = {{"visibility", ""}, {"NRMSE", "%"}, {"bias", "%"}},
                 .rows = {}};
    const auto add_other = [&](const std::string& name, Visibility visibility, int size) {
        const Metrics metrics = compare_with_reference(draw(visibility, size, 0, base.splat), name);
        others.rows.push_back({name, 100.0 * metrics.nrmse, 100.0 * metrics.bias});
    };
    add_other("none", Visibility::none, 64);
    add_other("classic shadow maps, 64x64", Visibility::shadow_maps, 64);
    add_other("classic shadow maps, 128x128", Visibility::shadow_maps, 128);

    Plot plot{.title = "Error of the bounced light",
              .note = fmt::format(
                  "Normalised root-mean-square error against the same {} VPLs with classic shadow maps "
                  "of {}x{} texels.",
                  base.vpls, k_reference_size, k_reference_size),
              .kind = Plot::Kind::lines,
              .x_label = "points a map",
              .y_label = "NRMSE, %",
              .x_log = true,
              .y_log = false,
              .series = {},
              .bar_names = {}};
    for (const Splat splat : splats) {
        Table table{.title = fmt::format("Error, splat {}", splat_name(splat)),
                    .note = "NRMSE, and the signed bias of the mean.",
                    .columns = {{"points a map", ""}},
                    .rows = {}};
        for (const int count : counts) {
            table.rows.push_back({static_cast<double>(count)});
        }
        Errors errors;
        for (const int size : sizes) {
            Series series{fmt::format("{0}, {1}x{1}", splat_name(splat), size), {}};
            table.columns.push_back({fmt::format("{0}x{0} NRMSE", size), "%"});
            table.columns.push_back({"bias", "%"});
            std::vector<double>& of_size = errors.emplace_back();
            for (size_t i = 0; i < counts.size(); ++i) {
                const Metrics metrics =
                    compare_with_reference(draw(Visibility::ism, size, counts[i], splat),
                                           fmt::format("{}, {} points", series.name, counts[i]));
                of_size.push_back(metrics.nrmse);
                series.points.push_back({static_cast<double>(counts[i]), 100.0 * metrics.nrmse});
                table.rows[i].emplace_back(100.0 * metrics.nrmse);
                table.rows[i].emplace_back(100.0 * metrics.bias);
            }
            plot.series.push_back(std::move(series));
        }
        add_checks(errors, splat_name(splat), report);
        report.tables.push_back(std::move(table));
    }
    report.tables.push_back(std::move(others));
    report.plots.push_back(std::move(plot));
    report.paper = {
        fmt::format("{}, Figure 4: NRMSE of Sponza against its GPU reference (256x256 classic shadow maps), "
                    "512 VPLs, "
                    "over points a map for three map sizes. Its text gives no values.",
                    k_paper_machine),
        "\"More point samples reduce the error. Increasing ISM resolution decreases the error as well; "
        "however, the "
        "difference in error between 128x128 and 256x256 is small.\"",
        "\"Note that the error does not fully vanish due to the G-Buffer\": its reference gathers all VPLs "
        "at every "
        "pixel. Ours is interleaved as the picture is, so that what is left comes from the maps alone."};
}

}  // namespace bounce::bench
