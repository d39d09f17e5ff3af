// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <tuple>

#include <fmt/format.h>

#include "bench/experiments.h"
#include "bench/room.h"
#include "cli/commands.h"
#include "cli/frame_list.h"
#include "cli/scene_source.h"
#include "core/atomic_file.h"
#include "core/interrupt.h"
#include "core/log.h"
#include "evaluate/machine.h"
#include "gl/context.h"

namespace bounce::cli {
namespace {

using bench::BenchOptions;

const std::map<std::string, Splat> k_splats = {{"disks", Splat::disks},
                                               {"compute", Splat::compute},
                                               {"points", Splat::points},
                                               {"tessellation", Splat::tessellation}};

constexpr int k_least_vpls = 16;
// Their maps of 256x256 fill the largest texture that drivers commonly have.
constexpr int k_most_vpls = 4096;

struct BenchArguments {
    std::string experiment;
    std::vector<std::string> scenes;
    std::string size;
    std::vector<std::string> sizes;
    std::filesystem::path output;
    SceneSourceOptions source;
    BenchOptions options;
};

std::vector<scene::Scene> bench_scenes(const BenchArguments& arguments) {
    std::vector<scene::Scene> scenes;
    for (const std::string& file : arguments.scenes) {
        scene::LoadResult loaded = load_scene(file, arguments.source);
        for (const std::string& warning : loaded.warnings) {
            log::warning("{}", warning);
        }
        scenes.push_back(std::move(loaded.scene));
    }
    if (scenes.empty()) {
        scenes.push_back(bench::make_room());
    }
    return scenes;
}

ExitCode run_bench(BenchArguments arguments) {
    const bench::Experiment& experiment = bench::find_experiment(arguments.experiment);
    if (!arguments.size.empty()) {
        std::tie(arguments.options.width, arguments.options.height) = parse_size(arguments.size);
    }
    for (const std::string& size : arguments.sizes) {
        arguments.options.sizes.push_back(parse_size(size));
    }
    if (arguments.scenes.size() > 1 && !experiment.many_scenes) {
        throw usage_error(fmt::format("bench {} measures one scene; {} were given", experiment.name,
                                      arguments.scenes.size()));
    }
    const std::vector<scene::Scene> scenes = bench_scenes(arguments);
    arguments.options.generated = arguments.scenes.empty();
    require_writable(arguments.output / "results.json");

    const gl::HeadlessContext context;
    const gl::DeviceInfo device = gl::initialise_current_context();
    const InterruptGuard interrupts;
    const bench::BenchInputs inputs{scenes.front(), arguments.options,
                                    device.software ? gl::TimingMode::finish : gl::TimingMode::query,
                                    interrupts, scenes};
    const bench::BenchReport report = bench::run_experiment(experiment, inputs, device, this_command());
    bench::write_bench_report(report, arguments.output);
    fmt::print("{}\nreport: {}\n", bench::report_text(report), (arguments.output / "index.html").string());
    if (report.bounds_broken > 0) {
        log::error("{} of what must hold does not: see the table", report.bounds_broken);
        return ExitCode::above_threshold;
    }
    return ExitCode::done;
}

std::string experiment_list() {
    std::string text = "Experiments:\n";
    for (const bench::Experiment& experiment : bench::experiments()) {
        text += fmt::format("  {:<14}{}\n", experiment.name, experiment.summary);
    }
    return text +
           "Each prints its tables and writes results.json and index.html, a page with plots that needs no\n"
           "network. It measures the program's own passes in steady state. docs/bench.md has the details.";
}

}  // namespace

void add_bench(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("bench", "Measure times and errors of the renderer's own passes");
    const auto arguments = std::make_shared<BenchArguments>();
    BenchOptions& options = arguments->options;
    command->add_option("experiment", arguments->experiment, "What to measure; listed below")->required();
    command->add_option(
        "scene", arguments->scenes,
        "Scene: .glb, .gltf or .blend; without it a room made in memory. Experiments auto and "
        "invariance take many");
    command->add_option("-o,--output", arguments->output, "Folder for results.json and index.html")
        ->required();
    command->add_option("--frame", options.frame, "Frame by Blender's number; the scene's first by default");
    command->add_option("--camera", options.camera,
                        "Camera node by name; the scene's active camera by default");
    command->add_option("--size", arguments->size, "Width and height in pixels; 640x360 by default");
    command
        ->add_option("--budgets", options.budgets_ms,
                     "auto: milliseconds a frame; 33, 100 and 250 by default")
        ->delimiter(',')
        ->check(CLI::PositiveNumber);
    command
        ->add_option("--sizes", arguments->sizes,
                     "auto: the picture's size for each budget, such as 96x54,160x90; --size for all")
        ->delimiter(',');
    command->add_option(
        "--references", options.references,
        "auto: pictures by Cycles with one bounce, such as refs/{scene}.{size}.exr; without them "
        "one of our own that has converged for 20 s");
    command->add_option("--repeat", options.repeat, "Times each setting is measured; 5 by default")
        ->check(CLI::Range(1, 1000));
    command->add_option("--vpls", options.vpls, "Virtual point lights where they are not varied")
        ->check(CLI::Range(k_least_vpls, k_most_vpls));
    command->add_option("--points", options.points, "Points a map where they are not varied")
        ->check(CLI::Range(16, 1 << 16));
    command->add_option("--ism-size", options.ism_size, "Texels a side of a map where it is not varied")
        ->check(CLI::IsMember({32, 64, 128, 256}));
    command
        ->add_option("--interleave", options.interleave, "Side of a block of pixels where it is not varied")
        ->check(CLI::IsMember({1, 2, 4, 8, 16}));
    command
        ->add_option_function<std::string>(
            "--splat", [&options](const std::string& name) { options.splat = k_splats.at(name); },
            "How points are splatted where it is not varied")
        ->check(CLI::IsMember(&k_splats));
    command
        ->add_option("--triangles", options.least_triangles,
                     "ism-creation: triangles to split the scene's into, at least")
        ->check(CLI::Range(1, 20'000'000))
        ->capture_default_str();
    command->add_option("--splats", options.most_splats, "ism-splats: splats in all maps together, at most")
        ->check(CLI::Range(10'000, 8'000'000))
        ->capture_default_str();
    command
        ->add_option("--longest", options.longest_s,
                     "ism-splats: leave out, and name, what is expected to take more seconds a frame")
        ->check(CLI::Range(0.001, 1e6));
    command->add_option("--only", options.only, "stress: only cases whose names hold this text");
    command
        ->add_option("--screen-divisor", options.screen_divisor,
                     "avg-table1, avg-table2: the paper's screens over this; 1 by default, 2 on a software "
                     "driver")
        ->check(CLI::Range(1, 8));
    command->add_option("--change", options.changes,
                        "invariance: make this change alone, as the table names it; may be given again");
    command->add_flag("--quick", options.quick,
                      "Few values, 160x90 pixels, once each: to see that it works, not to measure");
    add_scene_source_options(*command, arguments->source);
    command->footer(experiment_list());
    command->callback([arguments, &run] { run = [arguments] { return run_bench(*arguments); }; });
}

}  // namespace bounce::cli
