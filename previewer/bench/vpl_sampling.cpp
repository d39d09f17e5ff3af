// SPDX-License-Identifier: Apache-2.0
//
// Table 2 and Figures 6 to 8 of Barak, Bittner and Havran 2013, "Temporally Coherent Adaptive Sampling for
// Imperfect Shadow Maps": what samplers of virtual point lights cost, how bright pictures are by short
// chains, and how far each sampler's frames are from each other and from a reference.
#include <array>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include "bench/experiments.h"
#include "bench/walks.h"
#include "image/convolution.h"
#include "renderer/setting_names.h"

namespace bounce::bench {
namespace {

constexpr std::string_view k_machine =
    "Barák et al. 2013 (Core i7-3770, GeForce GTX 470, 512x512, 1,024 VPLs, 128 a pixel)";
constexpr int k_frames = 6;
constexpr int k_quick_frames = 2;
constexpr int k_reference_vpls = 4096;
constexpr double k_step = 0.001;  // of the scene's diagonal, that what moves moves by in a frame

// The samplers of the paper first: its Uniform, InvTM with two and three numbers, M-H-Our and M-H-Single.
constexpr std::array k_samplers = {VplSampling::uniform3,          VplSampling::inverse2,
                                   VplSampling::inverse3,          VplSampling::metropolis,
                                   VplSampling::metropolis_single, VplSampling::metropolis_unreduced,
                                   VplSampling::resampled,         VplSampling::inverse_transform};

// Table 2, milliseconds with 256, 512 and 1,024 lights.
struct PaperTime {
    VplSampling sampling;
    int steps;
    std::array<double, 3> ms;
};
const std::vector<PaperTime> k_table2 = {
    {VplSampling::uniform3, 1, {0.25, 0.24, 0.25}},    {VplSampling::inverse3, 1, {0.62, 0.62, 0.63}},
    {VplSampling::metropolis, 1, {0.26, 0.26, 0.26}},  {VplSampling::metropolis, 5, {0.30, 0.30, 0.31}},
    {VplSampling::metropolis, 10, {0.34, 0.34, 0.35}}, {VplSampling::metropolis, 20, {0.44, 0.45, 0.46}}};
constexpr std::array k_table2_vpls = {256, 512, 1024};

std::string label(VplSampling sampling) {
    return sampling == VplSampling::inverse_transform ? "cells" : name_of(sampling);
}

Settings base_settings(const BenchInputs& inputs, BenchReport& report) {
    Settings out = inputs.settings();
    out.width = inputs.options.width.value_or(inputs.options.quick ? 64 : 256);
    out.height = inputs.options.height.value_or(inputs.options.quick ? 36 : 144);
    out.vpls = inputs.options.vpls.value_or(inputs.options.quick ? 64 : 1024);
    out.splat = inputs.options.splat.value_or(Splat::compute);
    out.world_vpls = 0;
    out.vpl_importance = Importance::view;
    out.show = Show::indirect;
    change_setting(report, "size", fmt::format("{}x{}", out.width, out.height));
    change_setting(report, "VPLs", std::to_string(out.vpls));
    change_setting(report, "splat", splat_name(out.splat));
    report.settings.emplace_back("importance", name_of(out.vpl_importance));
    report.settings.emplace_back("importance pixels", fmt::format("{:g} %", out.importance_pixels));
    report.settings.emplace_back("importance floor", fmt::format("{:g}", out.importance_floor));
    report.settings.emplace_back("chain", fmt::format("{} proposals", out.vpl_steps));
    return out;
}

double pass_ms(const MeasuredFrame& measured, std::string_view name) {
    return measured.sum([name](const MeasuredPass& pass) { return pass.name == name; }).best();
}

void measure_times(const BenchInputs& inputs, Settings settings, BenchReport& report) {
    settings.visibility = Visibility::none;  // maps are not what is timed
    FrameBench bench = inputs.bench(inputs.scene);
    Table table{.title = "Time of sampling (Table 2)",
                .note = fmt::format("Sampling: pass \"vpl choice\", and for inverse transform the running "
                                    "sums, pass \"vpl importance\", "
                                    "as the paper counts it. Chains do without them; our lights' sizes take "
                                    "their total. The importance "
                                    "map is needed by all but uniform3. Paper: {}.",
                                    k_machine),
                .columns = {{"VPLs", ""},
                            {"sampler", ""},
                            {"proposals", ""},
                            {"choice", "ms"},
                            {"running sums", "ms"},
                            {"sampling", "ms"},
                            {"paper", "ms"},
                            {"over uniform3", "times"},
                            {"paper's over it", "times"},
                            {"importance map", "ms"}},
                .rows = {}};
    Plot plot{.title = "Time of sampling by chains (Table 2)",
              .note = "Dashed: the paper's, on its own machine.",
              .kind = Plot::Kind::lines,
              .x_label = "proposals",
              .y_label = "milliseconds",
              .x_log = false,
              .y_log = true,
              .series = {},
              .bar_names = {}};
    const auto counts = inputs.values(std::vector<size_t>{0, 1, 2});
    Progress progress("bench vpl-sampling, times", static_cast<int>(counts.size() * k_table2.size()));
    for (const size_t count : counts) {
        settings.vpls = k_table2_vpls.at(count);
        Series ours{fmt::format("{} VPLs", settings.vpls), {}, false};
        Series paper{fmt::format("paper, {} VPLs", settings.vpls), {}, true};
        double uniform = 0.0;
        for (const PaperTime& row : k_table2) {
            settings.vpl_sampling = row.sampling;
            settings.vpl_steps = row.steps;
            const MeasuredFrame measured = bench.measure(settings, inputs.repeat(), Measure::passes);
            const double choice = pass_ms(measured, "vpl choice");
            const double sums = pass_ms(measured, "vpl importance");
            const double sampling = choice + (row.sampling == VplSampling::inverse3 ? sums : 0.0);
            uniform = uniform > 0.0 ? uniform : sampling;
            const bool chain = row.sampling == VplSampling::metropolis;
            table.rows.push_back({static_cast<double>(settings.vpls), label(row.sampling),
                                  chain ? Cell{static_cast<double>(row.steps)} : Cell{}, choice, sums,
                                  sampling, row.ms.at(count), sampling / uniform,
                                  row.ms.at(count) / k_table2[0].ms.at(count),
                                  pass_ms(measured, "importance map")});
            if (chain) {
                ours.points.push_back({static_cast<double>(row.steps), sampling});
                paper.points.push_back({static_cast<double>(row.steps), row.ms.at(count)});
            }
            progress.step(fmt::format("{}: {:.2f} ms", label(row.sampling), sampling));
        }
        plot.series.push_back(std::move(ours));
        plot.series.push_back(std::move(paper));
    }
    report.tables.push_back(std::move(table));
    report.plots.push_back(std::move(plot));
}

// Over the reference's, per cent.
double intensity(const Image& image, const Image& reference) {
    return 100.0 * mean(luma(image)) / mean(luma(reference));
}

void measure_chain_lengths(const BenchInputs& inputs, const Settings& base, const Walk& walk,
                           Renderer& renderer, BenchReport& report) {
    const std::vector<int> lengths = inputs.values<int>({1, 2, 3, 5, 10, 20, 50});
    constexpr std::array k_chains = {VplSampling::metropolis, VplSampling::metropolis_unreduced,
                                     VplSampling::resampled};
    Table table{
        .title = "Mean intensity against the length of chains (Figure 6)",
        .note = fmt::format("Of the walk's first frame, over that of its reference, {} VPLs.", base.vpls),
        .columns = {{"proposals", ""}},
        .rows = {}};
    Plot plot{.title = table.title,
              .note = table.note,
              .kind = Plot::Kind::lines,
              .x_label = "proposals",
              .y_label = "mean intensity, % of the reference's",
              .x_log = true,
              .y_log = false,
              .series = {},
              .bar_names = {}};
    for (const VplSampling sampling : k_chains) {
        table.columns.push_back({label(sampling), "%"});
        plot.series.push_back({label(sampling), {}, false});
    }
    Progress progress("bench vpl-sampling, chains", static_cast<int>(lengths.size()));
    for (const int steps : lengths) {
        std::vector<Cell> row = {static_cast<double>(steps)};
        for (size_t i = 0; i < k_chains.size(); ++i) {
            Settings settings = base;
            settings.vpl_sampling = k_chains.at(i);
            settings.vpl_steps = steps;
            const double value =
                intensity(draw_shot(inputs, renderer, walk.shots[0], settings), walk.references[0]);
            row.emplace_back(value);
            plot.series[i].points.push_back({static_cast<double>(steps), value});
        }
        table.rows.push_back(std::move(row));
        progress.step(fmt::format("{} proposals", steps));
    }
    report.tables.push_back(std::move(table));
    report.plots.push_back(std::move(plot));
}

Plot frame_plot(const std::string& what, const std::string& y_label) {
    return {.title = what,
            .note = "",
            .kind = Plot::Kind::lines,
            .x_label = "frame",
            .y_label = y_label,
            .x_log = false,
            .y_log = true,
            .series = {},
            .bar_names = {}};
}

// Columns from the second on: TID and error, each over inverse3's, which `rows` holds by then or not.
void measure_walk(const BenchInputs& inputs, const Settings& base, const Walk& walk, Renderer& renderer,
                  Table& table, BenchReport& report) {
    Plot tid = frame_plot(fmt::format("Temporal image difference, {} (Figure 7)", walk.name),
                          "TID, % of the mean intensity");
    Plot error = frame_plot(fmt::format("Error, {} (Figure 7)", walk.name), "NRMSE, %");
    std::array<SequenceMetrics, k_samplers.size()> all;
    Progress progress("bench vpl-sampling, " + walk.name, static_cast<int>(all.size()));
    size_t inverse = 0;
    size_t metropolis = 0;
    for (size_t i = 0; i < all.size(); ++i) {
        Settings settings = base;
        settings.vpl_sampling = k_samplers.at(i);
        all.at(i) = run_walk(inputs, renderer, walk, settings);
        inverse = k_samplers.at(i) == VplSampling::inverse3 ? i : inverse;
        metropolis = k_samplers.at(i) == VplSampling::metropolis ? i : metropolis;
        Series tids{label(k_samplers.at(i)), {}, false};
        Series errors = tids;
        for (const SequenceFrame& frame : all.at(i).frames) {
            errors.points.push_back({static_cast<double>(frame.frame), 100.0 * frame.error->nrmse});
            if (frame.frame > 0) {
                tids.points.push_back(
                    {static_cast<double>(frame.frame), 100.0 * frame.tid / all.at(i).mean_luminance});
            }
        }
        tid.series.push_back(std::move(tids));
        error.series.push_back(std::move(errors));
        progress.step(
            fmt::format("{}: TID {:.2g} %", label(k_samplers.at(i)), 100.0 * all.at(i).tid_relative));
    }
    const SequenceMetrics& other = all.at(inverse);
    for (size_t i = 0; i < all.size(); ++i) {
        const SequenceMetrics& one = all.at(i);
        table.rows.push_back({walk.name, label(k_samplers.at(i)), 100.0 * one.tid_relative,
                              one.tid / other.tid, 100.0 * one.tid_reference / one.mean_luminance,
                              100.0 * mean_nrmse(one), mean_nrmse(one) / mean_nrmse(other),
                              100.0 * mean_bias(one)});
    }
    const SequenceMetrics& chains = all.at(metropolis);
    report.checks.push_back({walk.name + ": TID of metropolis over inverse3's", chains.tid / other.tid,
                             Check::Kind::at_most, 0.5, "times"});
    report.checks.push_back({walk.name + ": its RMSE over inverse3's", mean_nrmse(chains) / mean_nrmse(other),
                             Check::Kind::at_most, 1.15, "times"});
    report.plots.push_back(std::move(tid));
    report.plots.push_back(std::move(error));
}

void measure_dimensions(const BenchInputs& inputs, const Settings& base, const Walk& walk, Renderer& renderer,
                        BenchReport& report) {
    struct Kind {
        VplSampling sampling;
        const char* name;
    };
    constexpr std::array kinds = {Kind{VplSampling::inverse2, "r2"}, Kind{VplSampling::inverse3, "r3"},
                                  Kind{VplSampling::metropolis, "metropolis"}};
    struct Counts {
        int interleave;
        int vpls;
    };
    const auto counts = inputs.values<Counts>({{4, 256}, {1, 1024}, {4, 512}, {4, 1024}, {8, 1024}});
    Table table{
        .title = "TID by numbers drawn, lights and lights a pixel (Figure 8)",
        .note = fmt::format("{}. As the paper names it: a pixel gathers every n-th light.", walk.name),
        .columns = {{"ism-n-r-lights", ""}, {"TID", "%"}, {"NRMSE", "%"}},
        .rows = {}};
    Plot plot{.title = table.title,
              .note = table.note,
              .kind = Plot::Kind::stacked,
              .x_label = "",
              .y_label = "TID, % of the mean intensity",
              .x_log = false,
              .y_log = false,
              .series = {{"TID", {}, false}},
              .bar_names = {}};
    Progress progress("bench vpl-sampling, lights", static_cast<int>(kinds.size() * counts.size()));
    for (const Counts& count : counts) {
        for (const Kind& kind : kinds) {
            Settings settings = base;
            settings.vpl_sampling = kind.sampling;
            settings.vpls = count.vpls;
            settings.interleave = count.interleave;
            const SequenceMetrics metrics = run_walk(inputs, renderer, walk, settings);
            const std::string name =
                fmt::format("ism-{}-{}-{}", count.interleave * count.interleave, kind.name, count.vpls);
            const auto place = static_cast<double>(table.rows.size());
            table.rows.push_back({name, 100.0 * metrics.tid_relative, 100.0 * mean_nrmse(metrics)});
            plot.series[0].points.push_back({place, 100.0 * metrics.tid_relative});
            plot.bar_names.push_back(name);
            progress.step(name);
        }
    }
    report.tables.push_back(std::move(table));
    report.plots.push_back(std::move(plot));
}

// What of the program makes a sampler's frames differ: each part left out in turn.
void measure_causes(const BenchInputs& inputs, const Settings& base, const Walk& walk, Renderer& renderer,
                    BenchReport& report) {
    struct Part {
        const char* name;
        void (*change)(Settings&);
    };
    const auto parts = inputs.values<Part>(
        {{"as rendered", [](Settings&) {}},
         {"without near field, every light", [](Settings& s) { s.near_field = false, s.interleave = 1; }},
         {"without near field", [](Settings& s) { s.near_field = false; }},
         {"every light a pixel", [](Settings& s) { s.interleave = 1; }},
         {"the same lights, by flux", [](Settings& s) { s.vpl_importance = Importance::flux; }}});
    struct Kind {
        VplSampling sampling;
        int steps;  // 0: as many as elsewhere
    };
    constexpr std::array kinds = {Kind{VplSampling::inverse3, 0}, Kind{VplSampling::metropolis, 0},
                                  Kind{VplSampling::metropolis, 10}, Kind{VplSampling::resampled, 0}};
    Table table{.title = "Where the differences come from",
                .note = fmt::format(
                    "{}. Against the same reference; ratios to inverse3 in the same row group.", walk.name),
                .columns = {{"picture", ""},
                            {"sampler", ""},
                            {"proposals", ""},
                            {"TID", "%"},
                            {"over inverse3", "times"},
                            {"NRMSE", "%"},
                            {"over inverse3's", "times"},
                            {"bias", "%"}},
                .rows = {}};
    Progress progress("bench vpl-sampling, causes", static_cast<int>(parts.size() * kinds.size()));
    for (const Part& part : parts) {
        SequenceMetrics inverse;
        for (const Kind& kind : kinds) {
            Settings settings = base;
            part.change(settings);
            settings.vpl_sampling = kind.sampling;
            settings.vpl_steps = kind.steps > 0 ? kind.steps : settings.vpl_steps;
            const SequenceMetrics metrics = run_walk(inputs, renderer, walk, settings);
            if (kind.sampling == VplSampling::inverse3) inverse = metrics;
            const bool chain = passes::is_chain(kind.sampling);
            table.rows.push_back({part.name, label(kind.sampling),
                                  chain ? Cell{static_cast<double>(settings.vpl_steps)} : Cell{},
                                  100.0 * metrics.tid_relative, metrics.tid / inverse.tid,
                                  100.0 * mean_nrmse(metrics), mean_nrmse(metrics) / mean_nrmse(inverse),
                                  100.0 * mean_bias(metrics)});
            progress.step(fmt::format("{}, {}", part.name, label(kind.sampling)));
        }
    }
    report.tables.push_back(std::move(table));
}

// The camera, an object, a light.
std::vector<Motion> chosen_motions(const BenchInputs& inputs, const Settings& settings, BenchReport& report) {
    std::vector<Motion> out;
    if (const auto walk = walk_through(inputs, settings)) {
        out.push_back(*walk);
    }
    for (const Motion& motion : scene_motions(inputs, settings, k_step, report)) {
        if ((motion.name == "the camera" && out.empty()) || motion.name == "an object" ||
            motion.name == "a light") {
            out.push_back(motion);
        }
    }
    return out;
}

}  // namespace

void measure_vpl_sampling(const BenchInputs& inputs, BenchReport& report) {
    const Settings base = base_settings(inputs, report);
    // By what is seen as well: cells of equal flux have most of their lights where a wide scene is not looked
    // at.
    Settings reference = base;
    reference.vpls = inputs.options.quick ? 4 * base.vpls : k_reference_vpls;
    const int frames = inputs.options.quick ? k_quick_frames : k_frames;
    measure_times(inputs, base, report);
    Renderer renderer(inputs.scene);
    Table table{.title = "Temporal image difference and error by what moves",
                .note = fmt::format(
                    "{} frames, indirect light alone; object and light move by {:g} % of the scene's "
                    "diagonal a frame, a sun turns by {:g} degrees. TID: root mean square of luminance "
                    "less that of the same place a frame before, over the reference's mean. NRMSE: mean "
                    "over frames, against {} lights of --vpl-sampling inverse-transform (cells) by what "
                    "is seen.",
                    frames, 100.0 * k_step, glm::degrees(k_step), reference.vpls),
                .columns = {{"what moves", ""},
                            {"sampler", ""},
                            {"TID", "%"},
                            {"over inverse3", "times"},
                            {"reference's TID", "%"},
                            {"NRMSE", "%"},
                            {"over inverse3's", "times"},
                            {"bias", "%"}},
                .rows = {}};
    bool first = true;
    for (const Motion& motion : chosen_motions(inputs, base, report)) {
        const Walk walk = make_walk(inputs, renderer, motion, frames, reference);
        if (first) {
            measure_chain_lengths(inputs, base, walk, renderer, report);
            measure_dimensions(inputs, base, walk, renderer, report);
            measure_causes(inputs, base, walk, renderer, report);
        }
        first = false;
        measure_walk(inputs, base, walk, renderer, table, report);
    }
    report.tables.push_back(std::move(table));
    report.paper = {
        fmt::format("\"Metropolis-Hastings sampling provides the good trade-off: the RMSE is slightly "
                    "increased, while the temporal flickering is significantly reduced.\" ({}, "
                    "Crytek Sponza, 50 frames)",
                    k_machine),
        "\"The uniform sampling [...] has the lowest temporal flickering, but the quality of the indirect "
        "illumination is lower\""};
}

}  // namespace bounce::bench
