// SPDX-License-Identifier: Apache-2.0
//
// The experiments of `bounce bench`, each a function from a scene to a report.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/bench_report.h"
#include "bench/frame_bench.h"
#include "renderer/settings.h"
#include "scene/scene.h"

namespace bounce::bench {

// Settings that the user gave stand for the experiment's own; what an experiment varies it varies all the
// same.
struct BenchOptions {
    std::optional<int> width, height;
    std::optional<int> frame;
    std::string camera;
    std::optional<int> repeat;
    std::optional<int> vpls;
    std::optional<int> points;
    std::optional<int> ism_size;
    std::optional<int> interleave;
    std::optional<Splat> splat;
    int least_triangles = 70'000;  // ism-creation
    double most_splats = 8e6;      // ism-splats
    // ism-splats: a path is not measured with more splats where that is expected to take more seconds.
    std::optional<double> longest_s;
    // avg-: screens are the paper's over this; on a software driver half as wide and high by default.
    std::optional<int> screen_divisor;
    std::vector<std::string> changes;  // invariance: only these; all where there are none
    // auto: times a frame, and the picture's size for each, or for all.
    std::vector<double> budgets_ms{33.0, 100.0, 250.0};
    std::vector<std::pair<int, int>> sizes;
    std::string
        references;    // auto: pictures to compare with, {scene} and {size} in their names; may be empty
    std::string only;  // stress: cases whose names hold this
    bool generated = false;  // no scene was given: the room was made
    bool quick = false;      // few values, small picture, one repetition
};

struct BenchInputs {
    const scene::Scene& scene;
    const BenchOptions& options;
    gl::TimingMode timing;
    const InterruptGuard& interrupts;
    std::span<const scene::Scene> scenes;  // all that were given; the first is `scene`

    // The frame that was asked for, or the scene's first.
    [[nodiscard]] double frame() const { return frame_of(scene); }
    [[nodiscard]] double frame_of(const scene::Scene& of) const;
    [[nodiscard]] int repeat() const;
    // Defaults of the program with what the user gave; 640x360 without --size, a quarter of that with
    // --quick.
    [[nodiscard]] Settings settings() const;
    [[nodiscard]] FrameBench bench(const scene::Scene& scene) const;
    // The first two values where it has to be quick.
    template <typename T>
    [[nodiscard]] std::vector<T> values(std::vector<T> all) const {
        if (options.quick && all.size() > 2) all.resize(2);
        return all;
    }
};

// Fills tables, plots, checks and the paper's words; the caller says on what machine it was.
using RunExperiment = void (*)(const BenchInputs& inputs, BenchReport& report);
void measure_rsm_interpolation(const BenchInputs& inputs, BenchReport& report);
void measure_rates(const BenchInputs& inputs, BenchReport& report);
void measure_ism_error(const BenchInputs& inputs, BenchReport& report);
void measure_ism_scaling(const BenchInputs& inputs, BenchReport& report);
void measure_screen_sizes(const BenchInputs& inputs, BenchReport& report);
void measure_ism_creation(const BenchInputs& inputs, BenchReport& report);
void measure_splat_paths(const BenchInputs& inputs, BenchReport& report);
void measure_temporal_reuse(const BenchInputs& inputs, BenchReport& report);
void measure_simplified_maps(const BenchInputs& inputs, BenchReport& report);
void measure_simplified_map_sizes(const BenchInputs& inputs, BenchReport& report);
void measure_pixel_lights(const BenchInputs& inputs, BenchReport& report);
void measure_avg_stages(const BenchInputs& inputs, BenchReport& report);
void measure_avg_screens(const BenchInputs& inputs, BenchReport& report);
void measure_auto_budgets(const BenchInputs& inputs, BenchReport& report);
void measure_leaving_out(const BenchInputs& inputs, BenchReport& report);
void measure_vpl_sampling(const BenchInputs& inputs, BenchReport& report);
void measure_furnace(const BenchInputs& inputs, BenchReport& report);
void measure_invariance(const BenchInputs& inputs, BenchReport& report);
void measure_stress(const BenchInputs& inputs, BenchReport& report);

// Why an atlas of the settings' maps is not drawn: larger than the driver's texture_size, or than what these
// experiments take of memory. Empty where it is.
[[nodiscard]] std::string maps_too_large(const Settings& settings, int texture_size);

struct Experiment {
    std::string_view name;
    std::string_view title;
    std::string_view summary;  // for --help, a phrase
    RunExperiment run;
    bool many_scenes = false;       // otherwise one
    bool must_meet_checks = false;  // the program ends with 1 where one of its checks is not met
};
[[nodiscard]] const std::vector<Experiment>& experiments();

// Throws usage_error, which lists the names there are.
[[nodiscard]] const Experiment& find_experiment(std::string_view name);

// Runs it and describes the run: settings, machine, driver. command: as typed.
[[nodiscard]] BenchReport run_experiment(const Experiment& experiment, const BenchInputs& inputs,
                                         const gl::DeviceInfo& device, const std::string& command);

// As the options name it.
[[nodiscard]] std::string splat_name(Splat splat);

// What an experiment does with a setting, where it is not what the user or the program's default says.
void change_setting(BenchReport& report, std::string_view name, const std::string& value);

// The times of one setting as a row, in the order of part_columns(): the label, frame best and median, parts.
[[nodiscard]] std::vector<Column> part_columns(const Column& label);
[[nodiscard]] std::vector<Cell> part_row(const Cell& label, const MeasuredFrame& measured);
// Stacked bars of the parts of several settings.
[[nodiscard]] Plot part_plot(const std::string& title, const std::string& x_label,
                             const std::vector<std::pair<std::string, MeasuredFrame>>& bars);

// Triangles that a frame of the scene draws, instances counted.
[[nodiscard]] size_t drawn_triangles(const scene::Scene& scene, double frame);

inline constexpr std::string_view k_paper_machine =
    "Ritschel et al. 2008 (1.8 GHz CPU, NVIDIA GeForce 8800 GTX)";

}  // namespace bounce::bench
