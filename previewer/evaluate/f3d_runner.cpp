// SPDX-License-Identifier: Apache-2.0
#include "evaluate/f3d_runner.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/log.h"
#include "core/process.h"
#include "evaluate/blender_script.h"
#include "evaluate/cycles_runner.h"
#include "evaluate/embedded.h"
#include "evaluate/scratch_folder.h"
#include "evaluate/sha256.h"
#include "image/image_io.h"

namespace bounce {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

// Frames drawn before the ones that count: shaders are compiled by then. Even, as each press switches
// something.
constexpr int k_warm_up = 4;
// The frames that count take at least about this long together, so that a process's spread hardly shows.
constexpr double k_measured_seconds = 1.0;
constexpr int k_fewest = 8;
constexpr int k_most = 3200;

struct Light {
    const char* label;
    bool lit;
};
constexpr std::array k_lights{Light{"the file's lights", true}, Light{"its own lights", false}};

std::string comma(const json& values) {
    return fmt::format("{}", fmt::join(values.get<std::vector<double>>(), ","));
}

class F3dRun {
  public:
    F3dRun(const PeerJob& job, const PeerProgress& progress, PeerResult& result)
        : job_(job), progress_(progress), result_(result), cache_(job.cache, job.width, job.height) {}

    void run() {
        const auto f3d = find_program("f3d");
        if (!f3d) {
            throw Error(ExitCode::failed, "there is no f3d on PATH; install Debian's package f3d");
        }
        f3d_ = f3d->string();
        display_ = with_display();
        version_ = run_process({f3d_, "--version"}).output;
        for (const Light& light : k_lights) {
            result_.points.push_back({"f3d", light.label, {}});
        }
        std::vector<int> missing;
        for (const int frame : job_.frames) {
            if (!take_cached(frame)) {
                missing.push_back(frame);
            }
        }
        if (!missing.empty()) {
            export_frames(missing);
            for (const int frame : missing) {
                for (size_t i = 0; i < k_lights.size(); ++i) {
                    render(frame, i);
                }
            }
        }
    }

  private:
    [[nodiscard]] std::string key(int frame, size_t light) const {
        return peer_key(job_, frame,
                        fmt::format("f3d, {}, load apart\n{}\n{}", k_lights.at(light).label, version_,
                                    sha256_of_text(std::string(embedded::f3d_export_py()) +
                                                   shared_scripts_hash(job_.scene))));
    }

    [[nodiscard]] fs::path gltf(int frame, bool lit) const {
        return scratch_ / fmt::format("frame{}_{}.glb", frame, lit ? "lit" : "unlit");
    }

    bool take_cached(int frame) {
        if (job_.fresh) {
            return false;
        }
        std::vector<CachedRender> found;
        for (size_t i = 0; i < k_lights.size(); ++i) {
            auto render = cache_.load(key(frame, i));
            if (!render) {
                return false;
            }
            found.push_back(std::move(*render));
        }
        for (size_t i = 0; i < k_lights.size(); ++i) {
            result_.points[i].frames.push_back({frame, std::move(found[i]), true});
        }
        return true;
    }

    void export_frames(const std::vector<int>& frames) {
        json files = json::array();
        for (const int frame : frames) {
            files.push_back({{"frame", frame},
                             {"lit", gltf(frame, true).string()},
                             {"unlit", gltf(frame, false).string()}});
        }
        const BlenderEnd end = run_blender_script(
            {.blender = job_.blender,
             .scene = job_.scene,
             .name = "f3d_export.py",
             .text = embedded::f3d_export_py(),
             .description = {{"width", job_.width}, {"height", job_.height}, {"frames", files}},
             .display = {}},
            scratch_, [&](const std::string& kind, const json& event) {
                if (kind == "ready") {
                    files_ = event.at("files").get<std::vector<fs::path>>();
                } else if (kind == "frame") {
                    views_[event.at("frame").get<int>()] = event;
                }
            });
        if (end.failed || views_.size() != frames.size()) {
            throw Error(ExitCode::failed, end.reason);
        }
    }

    // Draws so many frames more than the first one in a process of its own; the picture is of the last.
    ProcessResult draw(int frame, bool lit, int presses, const fs::path& picture) {
        const json& view = views_.at(frame);
        const fs::path record = scratch_ / "presses.log";
        write_text_file(record, f3d_presses(presses));
        std::vector<std::string> command = display_;
        command.insert(
            command.end(),
            {f3d_, gltf(frame, lit).string(), "--output=" + picture.string(), "--dry-run",
             fmt::format("--resolution={},{}", job_.width, job_.height),
             "--camera-position=" + comma(view.at("position")),
             "--camera-focal-point=" + comma(view.at("focal_point")),
             "--camera-view-up=" + comma(view.at("view_up")),
             fmt::format("--camera-view-angle={}", view.at("view_angle").get<double>()),
             "--bg-color=" + comma(view.at("background")), "--interaction-test-play=" + record.string()});
        ProcessResult process = run_process(command);
        std::error_code code;
        if (process.exit_code != 0 || !fs::is_regular_file(picture, code)) {
            log::debug("{}", process.output);
            throw Error(ExitCode::failed, fmt::format("f3d ended with code {} after \"{}\"",
                                                      process.exit_code, last_line(process.output)));
        }
        return process;
    }

    // From the program's start to the loaded file, without a window; all of the start where f3d cannot say.
    [[nodiscard]] double load_seconds(int frame, bool lit) const {
        const ProcessResult process =
            run_process({f3d_, gltf(frame, lit).string(), "--dry-run", "--no-render"});
        if (process.exit_code != 0) {
            log::debug("f3d's load cannot be timed apart: {}", process.output);
            return std::numeric_limits<double>::infinity();
        }
        return process.seconds;
    }

    void render(int frame, size_t index) {
        const Light& light = k_lights.at(index);
        const fs::path picture = scratch_ / "f3d.png";
        const double once = draw(frame, light.lit, 0, picture).seconds;
        const ProcessResult first = draw(frame, light.lit, k_warm_up, picture);
        const double guess = std::max((first.seconds - once) / k_warm_up, 1e-4);
        int count = std::clamp(static_cast<int>(k_measured_seconds / guess), k_fewest, k_most);
        count += count % 2;
        ProcessResult last = draw(frame, light.lit, k_warm_up + count, picture);
        // The guess is made from few frames: where they were fewer than it takes, more.
        while (last.seconds - first.seconds < 0.5 * k_measured_seconds && count < k_most) {
            count = std::min(4 * count, k_most);
            last = draw(frame, light.lit, k_warm_up + count, picture);
        }
        CachedRender render;
        render.image = read_scene_linear(picture);
        if (render.image.width != job_.width || render.image.height != job_.height) {
            throw Error(ExitCode::failed,
                        fmt::format("f3d drew {} x {} pixels, not {} x {}", render.image.width,
                                    render.image.height, job_.width, job_.height));
        }
        render.seconds = (last.seconds - first.seconds) / count;
        if (!(render.seconds > 0.0)) {
            throw Error(ExitCode::failed, "the time of f3d's frames cannot be told from its start");
        }
        render.startup_seconds = std::max(once - render.seconds, 0.0);
        // What the file's load without a window leaves of the start, window and display with it.
        render.first_render_seconds = std::max(render.startup_seconds - load_seconds(frame, light.lit), 0.0);
        render.export_seconds = views_.at(frame).at("seconds");
        render.rss_peak_bytes = last.rss_peak_bytes;
        render.date = utc_now();
        cache_.store_or_warn(key(frame, index), render, files_);
        progress_(fmt::format("f3d, frame {}, {}: {:.3f} s", frame, light.label, render.seconds));
        result_.points.at(index).frames.push_back({frame, std::move(render), false});
    }

    const PeerJob& job_;
    const PeerProgress& progress_;
    PeerResult& result_;
    ScratchFolder scratch_;
    RenderCache cache_;
    std::string f3d_;
    std::string version_;
    std::vector<std::string> display_;
    std::map<int, json> views_;
    std::vector<fs::path> files_;
};

}  // namespace

std::string f3d_presses(int count) {
    std::string record = "# StreamVersion 1.1\n";
    for (int i = 0; i < count; ++i) {
        // B shows and hides the scale of colours, of which there is none: all it does is draw again.
        record += "KeyPressEvent 100 100 0 98 1 b 0\n";
    }
    return record;
}

void run_f3d(const PeerJob& job, const PeerProgress& progress, PeerResult& result) {
    result.name = "f3d";
    result.settings =
        "f3d, a viewer without bounced light or shadows, from the scene's camera; files by Blender's own "
        "exporter. It shows "
        "a picture for a screen, 8 bits a channel and cut off at white: the sRGB curve is undone before it "
        "is compared, and "
        "what was brighter than white is lost. Its point and spot lights do not fade with distance. Time: a "
        "long run of "
        "frames less a short one, over the difference in frames.";
    F3dRun(job, progress, result).run();
}

}  // namespace bounce
