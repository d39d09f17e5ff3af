// SPDX-License-Identifier: Apache-2.0
#include "evaluate/cycles_runner.h"

#include <algorithm>
#include <chrono>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/process.h"
#include "evaluate/blender_script.h"
#include "evaluate/embedded.h"
#include "evaluate/scene_files.h"
#include "evaluate/scratch_folder.h"
#include "evaluate/sha256.h"

namespace bounce {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

json job_to_json(const CyclesJob& job) {
    json frames = json::array();
    for (const CyclesRender& render : job.renders) {
        if (frames.empty() || frames.back()["frame"] != render.frame) {
            frames.push_back({{"frame", render.frame}, {"renders", json::array()}});
        }
        frames.back()["renders"].push_back({{"spp", render.spp},
                                            {"seed", render.seed},
                                            {"repeat", render.repeat},
                                            {"output", render.output.string()}});
    }
    const json bounces = job.bounces == k_own_light_paths ? json(nullptr) : json(job.bounces);
    return {{"width", job.width}, {"height", job.height}, {"bounces", bounces}, {"frames", frames}};
}

// Reads the lines that Blender prints while it works through a job.
class Listener {
  public:
    Listener(const CyclesJob& job,
             const std::function<void(const CyclesRender&, const CyclesReport&)>& on_render)
        : on_render_(on_render) {
        report_.renders = job.renders;
    }

    void line(std::string_view text) {
        // "Sample 0/16": the scene is with the device, sampling starts.
        if (text.find("| Sample 0/") != std::string_view::npos && !sampling_started_) {
            sampling_started_ = Clock::now();
        }
    }

    void handle(const std::string& kind, const json& event) {
        if (kind == "ready") {
            ready(event);
        } else if (kind == "begin") {
            begin_ = Clock::now();
            sampling_started_.reset();
        } else if (kind == "warm_up") {
            if (report_.first_render_seconds == 0.0) {
                report_.first_render_seconds = event.at("seconds");
            }
        } else if (kind == "render" && done_ < report_.renders.size()) {
            CyclesRender& render = report_.renders[done_++];
            render.seconds = event.at("seconds");
            render.all_seconds = event.value("seconds_all", std::vector<double>{});
            render.rss_peak_bytes = event.value("rss_peak_bytes", size_t{0});
            if (sampling_started_) {
                render.setup_seconds = std::chrono::duration<double>(*sampling_started_ - begin_).count();
            }
            if (on_render_) {
                on_render_(render, report_);
            }
        } else if (kind == "note") {
            report_.notes.push_back(event.at("message"));
        }
    }

    [[nodiscard]] bool complete() const { return done_ == report_.renders.size(); }
    [[nodiscard]] CyclesReport take() { return std::move(report_); }

  private:
    void ready(const json& event) {
        report_.version = event.at("version");
        report_.threads = event.at("threads");
        report_.files = event.at("files").get<std::vector<fs::path>>();
        report_.startup_seconds = std::chrono::duration<double>(Clock::now() - start_).count();
        const json& view = event.at("view");
        report_.view = {view.at("display_device"), view.at("view_transform"), view.at("look"),
                        view.at("exposure"), view.at("gamma")};
    }

    const std::function<void(const CyclesRender&, const CyclesReport&)>& on_render_;
    CyclesReport report_;
    size_t done_ = 0;
    Clock::time_point start_ = Clock::now();
    Clock::time_point begin_ = start_;
    std::optional<Clock::time_point> sampling_started_;
};

}  // namespace

CyclesReport run_cycles(const CyclesJob& job, const fs::path& blender,
                        const std::function<void(const CyclesRender&, const CyclesReport&)>& on_render) {
    const ScratchFolder scratch;
    Listener listener(job, on_render);
    const BlenderEnd end = run_blender_script(
        {.blender = blender,
         .scene = job.scene,
         .name = "cycles_render.py",
         .text = embedded::cycles_render_py(),
         .description = job_to_json(job),
         .display = {}},
        scratch, [&](const std::string& kind, const json& event) { listener.handle(kind, event); },
        [&](std::string_view line) { listener.line(line); });
    if (end.error) {
        throw *end.error;
    }
    if (end.failed || !listener.complete()) {
        throw input_error(fmt::format("Cycles could not render {}: {}", job.scene.string(), end.reason));
    }
    return listener.take();
}

std::string bounces_text(int bounces) {
    return bounces == k_own_light_paths ? "own light paths" : fmt::format("{} bounces", bounces);
}

std::string last_line(const std::string& output) {
    const size_t end = output.find_last_not_of("\r\n ");
    if (end == std::string::npos) {
        return "it printed nothing";
    }
    const size_t start = output.find_last_of("\r\n", end);
    return output.substr(start == std::string::npos ? 0 : start + 1,
                         end - (start == std::string::npos ? 0 : start));
}

std::string blender_version(const fs::path& blender) {
    const ProcessResult result = run_process({blender.string(), "--version"});
    if (result.exit_code != 0 || !result.output.starts_with("Blender ")) {
        throw Error(ExitCode::failed, fmt::format("{} --version does not answer like Blender: {}",
                                                  blender.string(), last_line(result.output)));
    }
    std::string version = result.output.substr(0, result.output.find('\n'));
    constexpr std::string_view key = "build hash: ";
    if (const size_t at = result.output.find(key); at != std::string::npos) {
        const size_t start = at + key.size();
        version += " " + result.output.substr(start, result.output.find('\n', start) - start);
    }
    return version;
}

std::string shared_scripts_hash(const fs::path& scene) {
    // A .blend is opened by Blender itself.
    const std::string_view import = is_blend(scene) ? std::string_view{} : embedded::cycles_import_gltf_py();
    return sha256_of_text(std::string(embedded::blender_job_py()) + std::string(import));
}

std::string cycles_scripts_hash(const fs::path& scene) {
    return sha256_of_text(shared_scripts_hash(scene) + std::string(embedded::cycles_render_py()));
}

}  // namespace bounce
