// SPDX-License-Identifier: Apache-2.0
#include "evaluate/pass_times.h"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/json_fault.h"
#include "core/log.h"
#include "core/process.h"
#include "evaluate/cycles_runner.h"

namespace bounce {
namespace fs = std::filesystem;

PassTimes pass_times_of(const nlohmann::json& stats) {
    PassTimes result;
    const auto& frame = stats.at("frames").at(0);
    result.frame = frame.at("frame");
    for (const auto& pass : frame.at("passes")) {
        const auto all = pass.at("gpu_ms_all").get<std::vector<double>>();
        const auto [least, most] = std::minmax_element(all.begin(), all.end());
        if (all.empty()) {
            throw Error(ExitCode::failed, "a pass was not timed");
        }
        result.passes.push_back(
            {pass.at("name"), pass.at("gpu_ms").get<double>() / 1000.0, *least / 1000.0, *most / 1000.0});
    }
    for (const auto& item : stats.at("left_out")) {
        result.left_out.push_back({item.at("pass"), item.at("reason")});
    }
    result.approximations = stats.at("approximations").get<std::vector<std::string>>();
    return result;
}

PassTimes measure_passes(const fs::path& bounce, const fs::path& scene, const PreviewRun& run, int frame,
                         int width, int height, int repeat, const fs::path& folder) {
    create_folder(folder);
    const fs::path stats = folder / "passes.json";
    std::vector<std::string> command{bounce.string(),
                                     "render",
                                     scene.string(),
                                     "-o",
                                     (folder / "passes.####.exr").string(),
                                     "--frames",
                                     std::to_string(frame),
                                     "--size",
                                     fmt::format("{}x{}", width, height),
                                     "--repeat",
                                     std::to_string(repeat),
                                     "--stats",
                                     stats.string()};
    command.insert(command.end(), run.render_arguments.begin(), run.render_arguments.end());
    const ProcessResult process = run_process(command);
    if (process.exit_code != 0) {
        throw Error(ExitCode::failed,
                    fmt::format("{}, {}: the passes could not be timed: bounce render ended with "
                                "code {} after \"{}\"",
                                run.name, run.label, process.exit_code, last_line(process.output)));
    }
    std::ifstream in(stats);
    try {
        PassTimes result = pass_times_of(nlohmann::json::parse(in));
        result.curve = run.name;
        result.label = run.label;
        return result;
    } catch (const nlohmann::json::exception& error) {
        throw Error(ExitCode::failed, fmt::format("{}, {}: {} cannot be used: {}", run.name, run.label,
                                                  stats.string(), json_fault(error)));
    }
}

}  // namespace bounce
