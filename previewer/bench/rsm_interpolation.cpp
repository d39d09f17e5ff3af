// SPDX-License-Identifier: Apache-2.0
//
// Table 1 of Dachsbacher and Stamminger 2005, "Reflective Shadow Maps": frames a second with screen-space
// interpolation, over samples and the size of the first pass; and how much light each sampling pattern keeps.
#include <algorithm>

#include <fmt/format.h>

#include "bench/experiments.h"
#include "image/metrics.h"
#include "renderer/setting_names.h"

namespace bounce::bench {
namespace {

constexpr std::string_view k_rsm_paper_machine =
    "Dachsbacher and Stamminger 2005 (2.4 GHz Pentium 4, NVIDIA Quadro FX 4000)";
constexpr int k_paper_side = 512;  // of the screen and of the reflective shadow map

// Rows of the paper's table with 32x32 screen quads, which ours does without.
struct PaperRow {
    const char* scene;
    int first_pass;  // samples a side
    int samples;
    double fps;
    double computed;  // indirect illuminations
};
const std::vector<PaperRow> k_paper_rows = {
    {"table", 32, 112, 24.2, 63299}, {"table", 32, 224, 14.3, 63299}, {"table", 64, 112, 22.0, 66120},
    {"table", 64, 224, 13.0, 66120}, {"lucy", 32, 112, 19.3, 77613},  {"lucy", 32, 224, 11.4, 77613},
    {"lucy", 64, 112, 15.8, 82031},  {"lucy", 64, 224, 9.1, 82031},   {"droids", 32, 112, 16.4, 95744},
    {"droids", 32, 224, 9.2, 95744}, {"droids", 32, 448, 4.8, 95744}, {"droids", 64, 112, 15.1, 98048},
    {"droids", 64, 224, 7.9, 98048}, {"droids", 64, 448, 4.2, 98048},
};

// The passes that evaluate the reflective shadow map or interpolate between such evaluations.
bool is_gather(const MeasuredPass& pass) {
    return pass.name.starts_with("rsm gather") || pass.name.starts_with("rsm interpolate");
}

// "24.2 table, 19.3 lucy": what the paper's scenes have in a row like this one.
Cell paper_cell(int first_pass, int samples, double PaperRow::*value) {
    std::string text;
    for (const PaperRow& row : k_paper_rows) {
        if (row.first_pass == first_pass && row.samples == samples) {
            text += fmt::format("{}{:g} {}", text.empty() ? "" : ", ", row.*value, row.scene);
        }
    }
    return text.empty() ? Cell{} : Cell{text};
}

Table interpolation_table(const BenchInputs& inputs, FrameBench& bench, Settings settings, Plot& plot,
                          Progress& progress) {
    Table table{.title = "Frames a second with screen-space interpolation",
                .note = fmt::format(
                    "Computed: pixels whose indirect light was evaluated in full, the first pass included. "
                    "Error: of the frame, against every pixel with the same samples. Paper: {}, 512x512, "
                    "32x32 screen quads.",
                    k_rsm_paper_machine),
                .columns = {{"samples", ""},
                            {"first pass", ""},
                            {"frames", "/s"},
                            {"computed", "pixels"},
                            {"share", "%"},
                            {"gather", "ms"},
                            {"speed-up", "x"},
                            {"relMSE added", ""},
                            {"bias added", "%"},
                            {"paper", "frames/s"},
                            {"paper, computed", "pixels"}},
                .rows = {}};
    const double pixels = static_cast<double>(settings.width) * settings.height;
    for (const int samples : inputs.values<int>({112, 224, 448})) {
        settings.rsm_samples = samples;
        settings.interpolate = false;
        const MeasuredFrame all = bench.measure(settings, inputs.repeat());
        const Image exact = bench.picture(settings);
        const double all_gather = all.sum(is_gather).best();
        Series series{fmt::format("{} samples", samples), {{1.0, 1e3 / all.frame.best()}}};
        progress.step(fmt::format("{} samples, every pixel: {:.1f} ms", samples, all.frame.best()));
        table.rows.push_back({static_cast<double>(samples),
                              "every pixel",
                              1e3 / all.frame.best(),
                              pixels,
                              100.0,
                              all_gather,
                              {},
                              {},
                              {},
                              {},
                              {}});
        settings.interpolate = true;
        // One in 16x16, 8x8 and 4x4 pixels: at 512x512 the paper's 32x32 and 64x64, and the default here.
        for (const int step : {16, 8, 4}) {
            settings.lowres_step = step;
            const MeasuredFrame measured = bench.measure(settings, inputs.repeat());
            Settings counting = settings;
            counting.count_gathered_pixels = true;
            FrameReport counted;
            const Image image = bench.picture(counting, &counted);
            const Metrics error = compare(image, exact, HdrFlip::leave_out);
            const int first_width = (settings.width + step - 1) / step;
            const int first_height = (settings.height + step - 1) / step;
            const double computed = counted.gathered_pixels + static_cast<double>(first_width) * first_height;
            const double gather = measured.sum(is_gather).best();
            progress.step(fmt::format("{} samples, first pass {}x{}: {:.1f} ms", samples, first_width,
                                      first_height, measured.frame.best()));
            const bool as_paper = settings.width == k_paper_side && settings.height == k_paper_side;
            table.rows.push_back({static_cast<double>(samples),
                                  fmt::format("{}x{}", first_width, first_height),
                                  1e3 / measured.frame.best(), computed, 100.0 * computed / pixels, gather,
                                  all_gather / gather, error.relmse, 100.0 * error.bias,
                                  as_paper ? paper_cell(first_width, samples, &PaperRow::fps) : Cell{},
                                  as_paper ? paper_cell(first_width, samples, &PaperRow::computed) : Cell{}});
            series.points.push_back({computed / pixels, 1e3 / measured.frame.best()});
        }
        plot.series.push_back(std::move(series));
    }
    return table;
}

Table pattern_table(const BenchInputs& inputs, FrameBench& bench, Settings settings, Progress& progress) {
    // Every texel at every pixel is slow: a tenth of the size.
    settings.width = std::max(settings.width / 10, 1);
    settings.height = std::max(settings.height / 10, 1);
    settings.interpolate = false;
    settings.show = Show::indirect;
    Table table{.title = "Light that a sampling pattern keeps",
                .note = fmt::format("Indirect light at {}x{}, against the sum over every texel of the map.",
                                    settings.width, settings.height),
                .columns = {{"pattern", ""}, {"samples", ""}, {"relMSE", ""}, {"bias", "%"}},
                .rows = {}};
    settings.rsm_full_sum = true;
    const Image exact = bench.picture(settings);
    settings.rsm_full_sum = false;
    progress.step("sum over every texel");
    for (const auto pattern : {passes::RsmPattern::uniform_radius, passes::RsmPattern::inverse_square,
                               passes::RsmPattern::paper_literal}) {
        settings.rsm_pattern = pattern;
        for (const int samples : inputs.values<int>({112, 224, 448, 1024})) {
            settings.rsm_samples = samples;
            const Metrics error = compare(bench.picture(settings), exact, HdrFlip::leave_out);
            table.rows.push_back(
                {name_of(pattern), static_cast<double>(samples), error.relmse, 100.0 * error.bias});
        }
        progress.step(fmt::format("pattern {}", name_of(pattern)));
    }
    return table;
}

}  // namespace

void measure_rsm_interpolation(const BenchInputs& inputs, BenchReport& report) {
    Settings settings = inputs.settings();
    settings.technique = Technique::rsm;
    if (!inputs.options.width && !inputs.options.quick) {
        settings.width = k_paper_side;
        settings.height = k_paper_side;
    }
    report.settings = {{"frame", fmt::format("{:g}", inputs.frame())},
                       {"size", fmt::format("{}x{}", settings.width, settings.height)},
                       {"technique", "rsm"},
                       {"RSM", fmt::format("{0}x{0}", settings.used_rsm_size())},
                       {"samples", "varied"},
                       {"bounces", "1"}};
    Plot plot{.title = "Frames a second against the share of pixels computed",
              .note = "",
              .kind = Plot::Kind::lines,
              .x_label = "share computed",
              .y_label = "frames a second",
              .x_log = true,
              .y_log = true,
              .series = {},
              .bar_names = {}};
    FrameBench bench = inputs.bench(inputs.scene);
    const auto settings_of_samples = static_cast<int>(inputs.values<int>({112, 224, 448}).size());
    Progress progress("bench rsm-table1", 4 * settings_of_samples + 4);
    report.tables.push_back(interpolation_table(inputs, bench, settings, plot, progress));
    report.tables.push_back(pattern_table(inputs, bench, settings, progress));
    if (settings.width == k_paper_side && settings.height == k_paper_side) {
        for (const char* scene : {"table", "lucy", "droids"}) {
            Series series{fmt::format("paper, {}, 224 samples", scene), {}, true};
            for (const PaperRow& row : k_paper_rows) {
                if (row.samples == 224 && std::string_view(row.scene) == scene) {
                    series.points.push_back({row.computed / (k_paper_side * k_paper_side), row.fps});
                }
            }
            plot.series.push_back(std::move(series));
        }
    }
    report.plots.push_back(std::move(plot));
    report.paper = {
        fmt::format("\"The performance does not only depend on the total number of computed indirect "
                    "illumination values, but also "
                    "suffers from pipeline stalls through the occlusion query.\" ({})",
                    k_rsm_paper_machine)};
}

}  // namespace bounce::bench
