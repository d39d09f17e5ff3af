// SPDX-License-Identifier: Apache-2.0
//
// Table 1 of the paper: screen sizes, with blocks of one size and with blocks that grow with the screen.
#include <fmt/format.h>

#include "bench/experiments.h"

namespace bounce::bench {
namespace {

struct ScreenSize {
    int width, height;
    double paper_fps;  // with blocks of 4x4
    int equal_block;   // that gives the quality of 640x480 with 4x4, and its rate
    double equal_fps;
};

const std::vector<ScreenSize> k_sizes = {{640, 480, 15.1, 4, 15.1},   {800, 600, 13.2, 8, 17.0},
                                         {1024, 768, 10.7, 8, 17.3},  {1280, 1024, 8.6, 16, 15.2},
                                         {1600, 1280, 6.3, 16, 14.7}, {1920, 1600, 4.6, 16, 12.1}};
// A block of 16x16 shares them out among 256 pixels; the paper's number leaves each of these four.
constexpr int k_paper_vpls = 1024;

}  // namespace

void measure_screen_sizes(const BenchInputs& inputs, BenchReport& report) {
    std::vector<ScreenSize> sizes = inputs.values(k_sizes);
    if (inputs.options.quick) {
        for (ScreenSize& size : sizes) {
            size = {size.width / 8, size.height / 8, 0.0, size.equal_block, 0.0};
        }
    }
    const std::vector<int> blocks = {4, 8, 16};
    Settings settings = inputs.settings();
    settings.vpls = inputs.options.vpls.value_or(inputs.options.quick ? settings.vpls : k_paper_vpls);
    change_setting(report, "VPLs", std::to_string(settings.vpls));
    change_setting(report, "size", "varied");
    change_setting(report, "interleave", "varied");

    FrameBench bench = inputs.bench(inputs.scene);
    Progress progress("bench ism-table1", static_cast<int>(sizes.size() * blocks.size()));
    Table all{.title = "Time against screen size and block",
              .note = "",
              .columns = part_columns({"screen and block", ""}),
              .rows = {}};
    Table beside{
        .title = "Frames a second beside the paper's",
        .note = fmt::format("Paper: {}, Sponza, 128x128 maps with 4K points. Same quality: the block grows "
                            "with the screen.",
                            k_paper_machine),
        .columns = {{"screen", ""},
                    {"4x4", "frames/s"},
                    {"paper, 4x4", "frames/s"},
                    {"block of same quality", ""},
                    {"same quality", "frames/s"},
                    {"paper, same quality", "frames/s"}},
        .rows = {}};
    Plot plot{.title = "Time of a frame against screen size",
              .note = "Dashed: the paper's, on its own machine and scene.",
              .kind = Plot::Kind::lines,
              .x_label = "million pixels",
              .y_label = "milliseconds a frame",
              .x_log = false,
              .y_log = false,
              .series = {},
              .bar_names = {}};
    for (const int block : blocks) {
        plot.series.push_back({fmt::format("blocks of {0}x{0}", block), {}});
    }
    Series same_quality{"block of same quality", {}};
    Series paper{"paper, 4x4", {}, true};
    Series paper_equal{"paper, same quality", {}, true};
    for (const ScreenSize& size : sizes) {
        const double pixels = size.width * size.height * 1e-6;
        const std::string name = fmt::format("{}x{}", size.width, size.height);
        Cell four;
        Cell equal;
        for (size_t i = 0; i < blocks.size(); ++i) {
            settings.width = size.width;
            settings.height = size.height;
            settings.interleave = blocks[i];
            const MeasuredFrame measured = bench.measure(settings, inputs.repeat());
            const double ms = measured.frame.best();
            progress.step(fmt::format("{}, block {}: {:.1f} ms", name, blocks[i], ms));
            all.rows.push_back(part_row(fmt::format("{0}, {1}x{1}", name, blocks[i]), measured));
            plot.series[i].points.push_back({pixels, ms});
            if (blocks[i] == 4) four = 1e3 / ms;
            if (blocks[i] == size.equal_block) {
                equal = 1e3 / ms;
                same_quality.points.push_back({pixels, ms});
            }
        }
        const bool in_paper = size.paper_fps > 0.0;
        beside.rows.push_back({name, four, in_paper ? Cell{size.paper_fps} : Cell{},
                               fmt::format("{0}x{0}", size.equal_block), equal,
                               in_paper ? Cell{size.equal_fps} : Cell{}});
        if (in_paper) {
            paper.points.push_back({pixels, 1e3 / size.paper_fps});
            paper_equal.points.push_back({pixels, 1e3 / size.equal_fps});
        }
    }
    plot.series.push_back(std::move(same_quality));
    if (!paper.points.empty()) {
        plot.series.push_back(std::move(paper));
        plot.series.push_back(std::move(paper_equal));
    }
    report.tables = {std::move(beside), std::move(all)};
    report.plots.push_back(std::move(plot));
    report.paper = {
        "\"The rendering performance can be kept almost constant for increasing screen resolutions by "
        "increasing the G-Buffer block size accordingly. This also keeps the quality approximately "
        "equivalent.\""};
}

}  // namespace bounce::bench
