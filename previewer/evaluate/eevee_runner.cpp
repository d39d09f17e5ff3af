// SPDX-License-Identifier: Apache-2.0
#include "evaluate/eevee_runner.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "evaluate/blender_script.h"
#include "evaluate/cycles_runner.h"
#include "evaluate/embedded.h"
#include "evaluate/picture_room.h"
#include "evaluate/scratch_folder.h"
#include "evaluate/sha256.h"
#include "image/image_io.h"

namespace bounce {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

constexpr std::array k_samples{1, 16, 64};

std::string scripts_hash(const fs::path& scene) {
    return sha256_of_text(std::string(embedded::eevee_render_py()) + shared_scripts_hash(scene));
}

class EeveeRun {
  public:
    EeveeRun(const PeerJob& job, const PeerProgress& progress, PeerResult& result)
        : job_(job), progress_(progress), result_(result), cache_(job.cache, job.width, job.height) {}

    void run() {
        for (const int samples : k_samples) {
            result_.points.push_back({"Eevee", label(samples), {}});
        }
        json frames = json::array();
        for (const int frame : job_.frames) {
            json renders = json::array();
            for (size_t i = 0; i < k_samples.size(); ++i) {
                if (!take_cached(frame, i)) {
                    renders.push_back(
                        {{"samples", k_samples.at(i)}, {"output", output(frame, k_samples.at(i)).string()}});
                }
            }
            if (!renders.empty()) {
                frames.push_back({{"frame", frame}, {"renders", renders}});
            }
        }
        if (!frames.empty()) {
            render(frames);
        }
    }

  private:
    static std::string label(int samples) {
        return fmt::format("{} {}", samples, samples == 1 ? "sample" : "samples");
    }

    [[nodiscard]] fs::path output(int frame, int samples) const {
        return scratch_ / fmt::format("eevee_{}_{}.exr", frame, samples);
    }

    [[nodiscard]] std::string key(int frame, int samples) const {
        return peer_key(job_, frame, fmt::format("Eevee, {} samples\n{}", samples, scripts_hash(job_.scene)));
    }

    bool take_cached(int frame, size_t index) {
        if (job_.fresh) {
            return false;
        }
        auto found = cache_.load(key(frame, k_samples.at(index)));
        if (!found) {
            return false;
        }
        add_notes(found->notes);
        result_.points[index].frames.push_back({frame, std::move(*found), true});
        return true;
    }

    void add_notes(const std::vector<std::string>& notes) {
        for (const std::string& note : notes) {
            if (std::find(result_.notes.begin(), result_.notes.end(), note) == result_.notes.end()) {
                result_.notes.push_back(note);
            }
        }
    }

    void render(const json& frames) {
        start_ = Clock::now();
        const BlenderEnd end = run_blender_script(
            {.blender = job_.blender,
             .scene = job_.scene,
             .name = "eevee_render.py",
             .text = embedded::eevee_render_py(),
             .description = {{"width", job_.width},
                             {"height", job_.height},
                             {"limit_seconds", job_.limit_seconds},
                             {"frames", frames}},
             .display = with_display()},
            scratch_, [&](const std::string& kind, const json& event) { handle(kind, event); });
        if (end.failed) {
            throw Error(ExitCode::failed, end.reason);
        }
    }

    void handle(const std::string& kind, const json& event) {
        if (kind == "ready") {
            startup_seconds_ = std::chrono::duration<double>(Clock::now() - start_).count();
            files_ = event.at("files").get<std::vector<fs::path>>();
            film_exposure_ = event.at("film_exposure");
            if (film_exposure_ != 1.0F) {
                add_notes({fmt::format("Eevee knows no film exposure: its pictures are multiplied by {}",
                                       film_exposure_)});
            }
        } else if (kind == "warm_up" && first_render_seconds_ == 0.0) {
            first_render_seconds_ = event.at("seconds");
        } else if (kind == "render") {
            take_render(job_frame(event), event);
        } else if (kind == "skip") {
            const int samples = event.at("samples");
            if (skipped_.insert(samples).second) {
                result_.left_out.push_back(
                    fmt::format("Eevee at {} samples is left out: a frame would take about {:.0f} s; "
                                "--peer-limit allows {:g} s",
                                samples, event.at("expected_seconds").get<double>(), job_.limit_seconds));
            }
        } else if (kind == "note") {
            add_notes({event.at("message").get<std::string>()});
        }
    }

    static int job_frame(const json& event) { return event.at("frame").get<int>(); }

    void take_render(int frame, const json& event) {
        const int samples = event.at("samples");
        const auto index =
            static_cast<size_t>(std::find(k_samples.begin(), k_samples.end(), samples) - k_samples.begin());
        CachedRender render;
        try {
            render.image = read_image(output(frame, samples));
        } catch (const Error&) {
            const auto full = no_room_for_picture(scratch_.path(), job_.width, job_.height);
            throw full ? *full : Error(ExitCode::failed, "a picture of Eevee is damaged");
        }
        for (float& value : render.image.rgb) {
            value *= film_exposure_;
        }
        render.seconds = event.at("seconds");
        render.all_seconds = event.value("seconds_all", std::vector<double>{});
        render.startup_seconds = startup_seconds_;
        render.first_render_seconds = first_render_seconds_;
        render.rss_peak_bytes = event.at("rss_peak_bytes");
        render.date = utc_now();
        render.notes = result_.notes;
        cache_.store_or_warn(key(frame, samples), render, files_);
        progress_(fmt::format("Eevee, frame {}, {}: {:.2f} s", frame, label(samples), render.seconds));
        result_.points.at(index).frames.push_back({frame, std::move(render), false});
    }

    const PeerJob& job_;
    const PeerProgress& progress_;
    PeerResult& result_;
    ScratchFolder scratch_;
    RenderCache cache_;
    Clock::time_point start_ = Clock::now();
    double startup_seconds_ = 0.0;
    double first_render_seconds_ = 0.0;
    float film_exposure_ = 1.0F;
    std::vector<fs::path> files_;
    std::set<int> skipped_;
};

}  // namespace

void run_eevee(const PeerJob& job, const PeerProgress& progress, PeerResult& result) {
    result.name = "Eevee";
    result.settings =
        "Blender's Eevee as the scene has it set (soft shadows, ambient occlusion, reflections), at 1, 16 "
        "and 64 samples; "
        "bloom, motion blur, depth of field and compositing off. It has no bounced light but from baked "
        "light probes, and "
        "none is baked. Time: renders of a frame after two that are not counted, the median of three below 2 "
        "s.";
    EeveeRun(job, progress, result).run();
}

}  // namespace bounce
