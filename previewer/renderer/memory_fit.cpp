// SPDX-License-Identifier: Apache-2.0
#include "renderer/memory_fit.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "core/error.h"

namespace bounce {
namespace {

constexpr double k_mebibyte = 1024.0 * 1024.0;

// Halves a setting down to `least`; the sentence where it did.
std::string halve(int& value, int least, const char* what) {
    if (value / 2 < least) {
        return {};
    }
    value /= 2;
    return fmt::format("{} {}", what, value);
}

using Step = std::function<std::string(Settings&, bool&)>;

// In the order in which they are given up, each as often as it can be.
const std::vector<Step>& steps() {
    static const std::vector<Step> all = {
        [](Settings&, bool& keeps) {
            const bool kept = keeps;
            keeps = false;
            return std::string(kept ? "nothing is kept between frames: frames take longer, and look the same"
                                    : "");
        },
        [](Settings& s, bool&) {
            const bool held = !s.frees_idle;
            s.frees_idle = true;
            return std::string(
                held ? "textures are freed between passes: frames take longer, and look the same" : "");
        },
        [](Settings& s, bool&) {
            int size = s.used_soft_shadow_size();
            std::string said = halve(size, 128, "maps of soft shadows have a side of");
            s.soft_shadow_size = said.empty() ? s.soft_shadow_size : size;
            return said;
        },
        [](Settings& s, bool&) { return halve(s.shadow_size, 1024, "shadow maps have a side of"); },
        [](Settings& s, bool&) {
            int size = s.used_rsm_size();
            std::string said = halve(size, 128, "reflective shadow maps have a side of");
            s.rsm_size = said.empty() ? s.rsm_size : size;
            return said;
        },
        [](Settings& s, bool&) {
            int count = s.used_shadow_samples();
            std::string said = halve(count, 16, "places on a light that throw its soft shadow:");
            s.shadow_samples = said.empty() ? s.shadow_samples : count;
            return said;
        },
        [](Settings& s, bool&) {
            return s.technique == Technique::ism
                       ? halve(s.ism_size, 32, "maps of bounced light have a side of")
                       : std::string();
        },
        [](Settings& s, bool&) { return halve(s.world_vpls, 64, "lights that stand for the world:"); },
        [](Settings& s, bool&) { return halve(s.emitter_vpls, 64, "lights on what emits:"); },
        [](Settings& s, bool&) {
            return s.bounces > 1 ? halve(s.bounce_vpls, 32, "lights of each further bounce:") : std::string();
        },
        [](Settings& s, bool&) {
            return s.technique == Technique::ism ? halve(s.vpls, 64, "lights of the first bounce:")
                                                 : std::string();
        },
        [](Settings& s, bool&) {
            return halve(s.transparent_layers, 1, "blended surfaces over each other:");
        },
        [](Settings& s, bool&) {
            const bool smooth = s.antialias;
            s.antialias = false;
            return std::string(smooth ? "outlines are not smoothed" : "");
        },
        [](Settings& s, bool&) { return halve(s.shadow_size, 256, "shadow maps have a side of"); },
    };
    return all;
}

size_t peak_of(Renderer& renderer, const std::vector<Moment>& moments, const Settings& settings, bool keeps) {
    renderer.expect_frames(keeps);
    size_t peak = 0;
    for (const Moment& moment : moments) {
        const FrameReport report = renderer.plan(moment.pose, moment.camera, settings);
        peak = std::max(peak, report.memory.value().peak());
    }
    return peak;
}

}  // namespace

size_t give_up_steps() {
    return steps().size();
}

std::string give_up(size_t step, Settings& settings, bool& keeps) {
    return steps().at(step)(settings, keeps);
}

MemoryFit fit_to_memory(Renderer& renderer, const std::vector<Moment>& moments, const Settings& settings,
                        bool keeps, size_t limit) {
    MemoryFit out{settings, keeps, peak_of(renderer, moments, settings, keeps), {}};
    for (size_t step = 0; step < give_up_steps(); ++step) {
        while (out.peak_bytes > limit) {
            MemoryFit next = out;
            const std::string said = give_up(step, next.settings, next.keeps);
            if (said.empty()) {
                break;
            }
            next.peak_bytes = peak_of(renderer, moments, next.settings, next.keeps);
            if (next.peak_bytes >= out.peak_bytes) {
                break;  // what frees nothing in this scene is not given up
            }
            next.changes.push_back(said);
            out = std::move(next);
        }
    }
    renderer.expect_frames(out.keeps);
    if (out.peak_bytes > limit) {
        throw usage_error(fmt::format(
            "{}x{} pixels of {} need {:.1f} MiB of GPU memory with the least settings, and the limit is "
            "{:.1f}: raise "
            "--memory-limit or give a smaller --size",
            settings.width, settings.height, renderer.gpu_scene().source().name,
            static_cast<double>(out.peak_bytes) / k_mebibyte, static_cast<double>(limit) / k_mebibyte));
    }
    return out;
}

}  // namespace bounce
