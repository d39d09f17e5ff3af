// SPDX-License-Identifier: Apache-2.0
#include "renderer/memory_fit.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "core/error.h"
#include "gl/memory.h"

namespace bounce {
namespace {

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

size_t peak_of(Renderer& renderer, const Moment& moment, const Settings& settings, bool keeps) {
    renderer.expect_frames(keeps);
    return renderer.plan(moment.pose, moment.camera, settings).memory.value().peak();
}

// Gives up what one frame needs.
void fit_frame(Renderer& renderer, const Moment& moment, size_t limit, MemoryFit& fit) {
    size_t peak = peak_of(renderer, moment, fit.settings, fit.keeps);
    for (size_t step = 0; step < give_up_steps(); ++step) {
        while (peak > limit) {
            Settings settings = fit.settings;
            bool keeps = fit.keeps;
            const std::string said = give_up(step, settings, keeps);
            const size_t less = said.empty() ? peak : peak_of(renderer, moment, settings, keeps);
            if (less >= peak) {
                break;  // what frees nothing in this scene is not given up
            }
            fit.settings = settings;
            fit.keeps = keeps;
            fit.changes.push_back(said);
            peak = less;
        }
    }
    if (peak > limit) {
        throw usage_error(fmt::format(
            "{}x{} pixels of {} need {:.3g} MiB of GPU memory with the least settings, and the limit is "
            "{:.3g}: raise --memory-limit or give a smaller --size",
            fit.settings.width, fit.settings.height, renderer.gpu_scene().source().name,
            static_cast<double>(peak) / gl::k_mebibyte, static_cast<double>(limit) / gl::k_mebibyte));
    }
    fit.peak_bytes = std::max(fit.peak_bytes, peak);
}

}  // namespace

size_t give_up_steps() {
    return steps().size();
}

std::string give_up(size_t step, Settings& settings, bool& keeps) {
    return steps().at(step)(settings, keeps);
}

MemoryFit fit_to_memory(Renderer& renderer, size_t count, const MomentAt& at, const Settings& settings,
                        bool keeps, size_t limit) {
    MemoryFit out{settings, keeps, 0, {}};
    // What a frame gives up may be of no use to one before, but never raises what that one needs.
    for (size_t i = 0; i < count; ++i) {
        at(i, [&](const Moment& moment) { fit_frame(renderer, moment, limit, out); });
    }
    renderer.expect_frames(out.keeps);
    return out;
}

}  // namespace bounce
