// SPDX-License-Identifier: Apache-2.0
#include <charconv>
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
#include "core/error.h"
#include "core/process.h"
#include "evaluate/evaluation.h"
#include "evaluate/report.h"

namespace bounce::cli {
namespace {

struct EvaluateArguments {
    EvaluateOptions options;
    std::string frames = "1";
    std::string size = "640x360";
    std::string reference_spp = "auto";
    std::vector<int> cycles_spp;
    std::vector<std::string> peers = known_peers();
    std::filesystem::path output;
    SweepOptions sweep;
};

// Each number once; a frame or a point is rendered once however often it is named.
std::vector<int> rising(const std::vector<int>& numbers) {
    const std::set<int> sorted(numbers.begin(), numbers.end());
    return {sorted.begin(), sorted.end()};
}

// As many as tell something against such a reference: beyond it its own noise is measured.
std::vector<int> default_cycles_spp(const ReferenceGoal& goal) {
    std::vector<int> ladder{1, 4, 16, 64, 256};
    const int most = goal.spp > 0 ? goal.spp : goal.limit_spp;
    std::erase_if(ladder, [&](int spp) { return spp >= most; });
    return ladder;
}

// A number of samples; 0 for "auto".
int parse_reference_spp(const std::string& text) {
    if (text == "auto") {
        return 0;
    }
    int spp = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), spp);
    if (code != std::errc{} || end != text.data() + text.size() || spp < 2 || spp % 2 != 0) {
        throw usage_error(
            "--reference-spp: give auto or an even number; a reference is two halves with different seeds");
    }
    return spp;
}

// Each once; "none" for none of them.
std::vector<std::string> chosen_peers(const std::vector<std::string>& named) {
    const std::set<std::string> once(named.begin(), named.end());
    if (once.contains("none")) {
        if (once.size() > 1) {
            throw usage_error("--peers: none stands alone");
        }
        return {};
    }
    return {once.begin(), once.end()};
}

ExitCode run_evaluate(const CLI::App& command, EvaluateArguments arguments) {
    EvaluateOptions& options = arguments.options;
    options.frames = rising(parse_frames(arguments.frames));
    options.reference.spp = parse_reference_spp(arguments.reference_spp);
    options.cycles_spp =
        arguments.cycles_spp.empty() ? default_cycles_spp(options.reference) : rising(arguments.cycles_spp);
    options.peers = chosen_peers(arguments.peers);
    if (options.reference.spp > 0 && command.count("--reference-limit") > 0) {
        throw usage_error("--reference-limit has no effect with a stated number of samples");
    }
    std::tie(options.width, options.height) = parse_size(arguments.size);
    options.bounce = executable_path();
    options.runs = default_preview_runs(options.bounces);
    options.command = this_command();
    arguments.sweep.apply(command, arguments.output, options);
    if (!options.given_reference.empty() && options.cycles_spp.empty() && command.count("--peers") == 0) {
        options.peers.clear();  // they need Blender, which nothing else does then
    }
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
    command
        ->add_option("--reference-spp", arguments->reference_spp,
                     "Samples per pixel of the reference; auto: until its noise floor is a tenth of the "
                     "smallest error measured against it")
        ->capture_default_str();
    command
        ->add_option("--reference-limit", options.reference.limit_spp,
                     "Samples per pixel at which auto stops")
        ->check(CLI::Range(2, 1 << 24))
        ->capture_default_str();
    command
        ->add_option(
            "--cycles-spp", arguments->cycles_spp,
            "Samples per pixel of the points on Cycles' curve; 1,4,16,64,256 below those of the reference")
        ->delimiter(',')
        ->check(CLI::Range(1, 1 << 20));
    std::vector<std::string> known = known_peers();
    known.emplace_back("none");
    command
        ->add_option("--peers", arguments->peers, "Engines beside Cycles, where they are installed, or none")
        ->delimiter(',')
        ->check(CLI::IsMember(known))
        ->capture_default_str();
    command
        ->add_option("--peer-limit", options.peer_limit_seconds,
                     "Leave out steps of a peer whose frame is expected to take more seconds")
        ->check(CLI::Range(0.1, 1e6))
        ->capture_default_str();
    command->add_flag(
        "--final-render", options.final_render,
        "Compare with the scene as Cycles renders it by its own light paths as well, which takes a "
        "second reference");
    command->add_flag("--fresh", options.fresh,
                      "Measure the other engines anew, also what an earlier run has measured here");
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
