// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/frame_list.h"
#include "cli/scene_source.h"
#include "cli/sweep_options.h"
#include "core/atomic_file.h"
#include "core/process.h"
#include "evaluate/evaluation.h"
#include "evaluate/report.h"

namespace bounce::cli {
namespace {

struct EvaluateArguments {
    EvaluateOptions options;
    std::string frames = "1";
    std::string size = "640x360";
    std::vector<int> cycles_spp{1, 4, 16, 64};
    std::filesystem::path output;
    SweepOptions sweep;
};

// Each number once; a frame or a point is rendered once however often it is named.
std::vector<int> rising(const std::vector<int>& numbers) {
    const std::set<int> sorted(numbers.begin(), numbers.end());
    return {sorted.begin(), sorted.end()};
}

ExitCode run_evaluate(const CLI::App& command, EvaluateArguments arguments) {
    EvaluateOptions& options = arguments.options;
    options.frames = rising(parse_frames(arguments.frames));
    options.cycles_spp = rising(arguments.cycles_spp);
    if (options.reference_spp < 2 || options.reference_spp % 2 != 0) {
        throw usage_error(
            "--reference-spp: give an even number; the reference is two halves with different seeds");
    }
    std::tie(options.width, options.height) = parse_size(arguments.size);
    options.bounce = executable_path();
    options.runs = default_preview_runs(options.bounces);
    options.command = this_command();
    arguments.sweep.apply(command, arguments.output, options);
    // Before the minutes of rendering, not after.
    require_writable(arguments.output / "results.json");
    const Evaluation evaluation = evaluate(options);
    write_report(evaluation, arguments.output);
    fmt::print("{}\nreport: {}\n", results_table(evaluation), (arguments.output / "index.html").string());
    return arguments.sweep.finish(evaluation, arguments.output);
}

}  // namespace

void add_evaluate(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("evaluate", "Report error against run time, against Cycles");
    const auto arguments = std::make_shared<EvaluateArguments>();
    EvaluateOptions& options = arguments->options;
    command->add_option("scene", options.scene, "Scene: .blend, .glb or .gltf")->required();
    command
        ->add_option("-o,--output", arguments->output, "Folder for results.json, results.csv and index.html")
        ->required();
    command->add_option("--frames", arguments->frames, "Frames by Blender's numbers: 1,24 or 1-4")
        ->capture_default_str();
    command->add_option("--size", arguments->size, "Width and height in pixels")->capture_default_str();
    command->add_option("--reference-spp", options.reference_spp, "Samples per pixel of the reference")
        ->capture_default_str();
    command
        ->add_option("--cycles-spp", arguments->cycles_spp,
                     "Samples per pixel of the points on Cycles' curve")
        ->delimiter(',')
        ->check(CLI::Range(1, 1 << 20))
        ->capture_default_str();
    command
        ->add_option("--bounces", options.bounces,
                     "Bounces off surfaces that Cycles renders; Bounce renders as many, up to 4")
        ->check(CLI::Range(0, 16))
        ->capture_default_str();
    command->add_option("--repeat", options.repeat, "Renders of each frame by Bounce; their median counts")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    arguments->sweep.add_to(*command);
    add_scene_source_options(*command, options.source);
    command->callback([command, arguments, &run] {
        run = [command, arguments] { return run_evaluate(*command, *arguments); };
    });
}

}  // namespace bounce::cli
