// SPDX-License-Identifier: Apache-2.0
#include "evaluate/preview_run.h"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/json_fault.h"
#include "core/log.h"
#include "core/process.h"
#include "evaluate/record_file.h"

namespace bounce {
namespace fs = std::filesystem;
namespace {

// The program's own sentence: what follows "error: ", else the last line.
std::string sentence_in(const std::string& output) {
    constexpr std::string_view prefix = "error: ";
    size_t start = output.rfind(prefix);
    if (start != std::string::npos) {
        start += prefix.size();
        return output.substr(start, output.find('\n', start) - start);
    }
    const size_t end = output.find_last_not_of('\n');
    if (end == std::string::npos) {
        return "it printed nothing";
    }
    const size_t line = output.rfind('\n', end);
    return output.substr(line == std::string::npos ? 0 : line + 1,
                         end - (line == std::string::npos ? 0 : line) + 1);
}

// As many as `bounce render` draws.
constexpr int k_most_bounces = 4;

std::string frame_file(int frame) {
    return fmt::format("frame.{:04}.exr", frame);
}

PreviewResult read_stats(const fs::path& stats, const std::vector<int>& frames, const fs::path& folder,
                         double process_seconds) {
    std::ifstream in(stats);
    const auto json = nlohmann::json::parse(in);
    PreviewResult result;
    double rendering = 0.0;
    for (const auto& item : json.at("frames")) {
        PreviewFrame frame;
        frame.frame = item.at("frame").get<int>();
        frame.seconds = item.at("wall_ms").get<double>() / 1000.0;
        frame.image = folder / frame_file(frame.frame);
        if (item.contains("wall_ms_all")) {
            for (const auto& wall : item["wall_ms_all"]) {
                frame.all_seconds.push_back(wall.get<double>() / 1000.0);
                rendering += frame.all_seconds.back();
            }
        } else {
            rendering += frame.seconds;
        }
        result.frames.push_back(frame);
    }
    std::vector<int> rendered;
    std::transform(result.frames.begin(), result.frames.end(), std::back_inserter(rendered),
                   [](const PreviewFrame& frame) { return frame.frame; });
    if (rendered != frames) {
        throw Error(ExitCode::failed, fmt::format("{} tells of frames {}, not {}", stats.string(),
                                                  fmt::join(rendered, ", "), fmt::join(frames, ", ")));
    }
    const auto gl = json.value("gl", nlohmann::json::object());
    result.gl_vendor = gl.value("vendor", "");
    result.gl_renderer = gl.value("renderer", "");
    result.gl_version = gl.value("version", "");
    const auto memory = json.value("memory", nlohmann::json::object());
    result.rss_peak_bytes = memory.value("rss_peak_bytes", size_t{0});
    result.gl_peak_bytes = memory.value("gl_peak_bytes", size_t{0});
    const auto& startup = json.at("startup");
    result.load_seconds = (finite_number(startup, "load_ms") + finite_number(startup, "upload_ms")) / 1000.0;
    result.first_frame_seconds = finite_number(startup, "first_frame_ms") / 1000.0;
    if (process_seconds > 0.0) {
        result.startup_seconds = std::max(process_seconds - rendering, 0.0);
        result.start_seconds = std::max(process_seconds - finite_number(json, "run_ms") / 1000.0, 0.0) +
                               finite_number(startup, "context_ms") / 1000.0;
    }
    return result;
}

}  // namespace

PreviewResult read_preview(const fs::path& folder, const std::vector<int>& frames) {
    return read_stats(folder / "stats.json", frames, folder, 0.0);
}

std::vector<PreviewRun> default_preview_runs(int bounces) {
    std::vector<PreviewRun> runs{{"Direct light only", "direct", {"--technique", "direct"}}};
    if (bounces < 1) {
        return runs;
    }
    for (const int samples : {112, 448}) {
        runs.push_back({"RSM, not occluded",
                        fmt::format("{} samples", samples),
                        {"--technique", "rsm", "--rsm-samples", std::to_string(samples)}});
    }
    const int most = std::min(bounces, k_most_bounces);
    const auto add = [&](const std::string& name, int vpls, int of, std::vector<std::string> more) {
        PreviewRun run{
            name, fmt::format("{} VPLs", vpls), {"--technique", "ism", "--vpls", std::to_string(vpls)}};
        if (of > 1) {
            run.render_arguments.insert(run.render_arguments.end(), {"--bounces", std::to_string(of)});
        }
        run.render_arguments.insert(run.render_arguments.end(), more.begin(), more.end());
        runs.push_back(run);
    };
    for (const int vpls : {64, 256, 1024}) {
        add("VPLs, not occluded", vpls, most, {"--visibility", "none"});
    }
    if (most > 1) {
        add("ISM, one bounce", 256, 1, {});
    }
    for (const int vpls : {64, 128, 256, 512, 1024}) {
        add(most > 1 ? fmt::format("ISM, {} bounces", most) : "ISM", vpls, most, {});
    }
    return runs;
}

PreviewResult run_preview(const fs::path& bounce, const fs::path& scene, const PreviewRun& run,
                          const std::vector<int>& frames, int width, int height, int repeat,
                          const fs::path& folder) {
    create_folder(folder);
    const fs::path stats = folder / "stats.json";
    std::vector<std::string> command{bounce.string(),
                                     "render",
                                     scene.string(),
                                     "-o",
                                     (folder / "frame.####.exr").string(),
                                     "--frames",
                                     fmt::format("{}", fmt::join(frames, ",")),
                                     "--size",
                                     fmt::format("{}x{}", width, height),
                                     "--repeat",
                                     std::to_string(repeat),
                                     "--no-pass-times",
                                     "--stats",
                                     stats.string()};
    command.insert(command.end(), run.render_arguments.begin(), run.render_arguments.end());
    log::debug("{}", fmt::join(command, " "));
    const ProcessResult result = run_process(command);
    if (result.exit_code != 0) {
        // The causes that are the user's to mend keep their codes; another one is ours.
        const bool known = result.exit_code == static_cast<int>(ExitCode::input_refused) ||
                           result.exit_code == static_cast<int>(ExitCode::no_opengl);
        throw Error(known ? static_cast<ExitCode>(result.exit_code) : ExitCode::failed,
                    fmt::format("{}, {}: bounce render ended with code {}: {}", run.name, run.label,
                                result.exit_code, sentence_in(result.output)));
    }
    try {
        return read_stats(stats, frames, folder, result.seconds);
    } catch (const nlohmann::json::exception& error) {
        throw Error(ExitCode::failed, fmt::format("{}, {}: {} cannot be used: {}", run.name, run.label,
                                                  stats.string(), json_fault(error)));
    }
}

}  // namespace bounce
