// SPDX-License-Identifier: Apache-2.0
#include "renderer/converge.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "core/stopwatch.h"
#include "passes/pixel_filter.h"
#include "renderer/setting_names.h"
#include "scene/points/sobol.h"

namespace bounce {
namespace {

// Scrambles the places in the pixel; any will do, but a picture should not change by chance.
constexpr uint32_t k_offset_seed = 0x5eed0ff5U;

// The error is looked at after so many passes more than the last time, or a tenth more: reading the picture
// back takes time that passes could use.
constexpr double k_look_growth = 1.1;

// Pixels that a pass's smoothing of shadows covers shrink as passes cover more themselves; beyond this it
// makes no difference.
constexpr int k_most_samples = 64;

// Before that the error says little about how it will fall.
constexpr int k_settled_passes = 16;

// Passes from which maps are larger.
constexpr int k_first_growth = 4;
constexpr int k_second_growth = 16;
constexpr int k_first_sharper_maps = 32;
constexpr int k_second_sharper_maps = 256;

// Texels a side of a reflective map at most: all are summed up in every pass.
constexpr int k_most_rsm_texels = 1024;

// On a light with a size, in each pass but the first.
constexpr int k_places = 16;

void add_times(std::vector<gl::PassTime>& sums, const std::vector<gl::PassTime>& times) {
    for (const gl::PassTime& time : times) {
        const auto same = std::find_if(sums.begin(), sums.end(),
                                       [&](const gl::PassTime& sum) { return sum.name == time.name; });
        if (same == sums.end()) {
            sums.push_back(time);
        } else {
            same->gpu_ms += time.gpu_ms;
            same->cpu_ms += time.cpu_ms;
        }
    }
}

// The picture, and the mean of its pixels' estimated errors.
double read_picture(Renderer& renderer, int passes, Converged& out) {
    const std::vector<glm::vec4> pixels = renderer.resolve_many();
    const gl::TextureDesc desc = renderer.color().desc();
    out.picture = Image(desc.width, desc.height);
    out.faulty_pixels = 0;
    double error = 0.0;
    for (size_t i = 0; i < pixels.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            out.picture.rgb[3 * i + static_cast<size_t>(c)] = pixels[i][c];
        }
        const double sum = double{pixels[i].r} + pixels[i].g + pixels[i].b + pixels[i].a;
        out.faulty_pixels += std::isfinite(sum) ? 0 : 1;
        error += pixels[i].a;
    }
    return passes > 1 ? error / static_cast<double>(pixels.size()) : -1.0;
}

}  // namespace

VarianceBounds variance_bounds(int samples) {
    assert(samples > 1);
    const double freedom = samples - 1;
    const auto quantile = [&](double normal) {
        const double a = 2.0 / (9.0 * freedom);
        return freedom * std::pow(std::max(1.0 - a + normal * std::sqrt(a), 0.0), 3.0);
    };
    constexpr double k_normal = 1.959963984540054;
    // With one degree of freedom the approximation's low quantile is 0; the true one is 0.00098.
    return {freedom / quantile(k_normal), freedom / std::max(quantile(-k_normal), 9.8e-4)};
}

glm::dvec2 converge_offset(int number) {
    if (number <= 1) {
        return {0.0, 0.0};
    }
    if (number <= k_smoothed_passes) {
        const glm::dvec3 u = scene::sobol_point(static_cast<uint32_t>(number - 1), k_offset_seed);
        return 0.5 * (glm::dvec2(u) - 0.5);
    }
    const glm::dvec3 u =
        scene::sobol_point(static_cast<uint32_t>(number - k_smoothed_passes - 1), k_offset_seed);
    return {passes::pixel_filter_quantile(u.x), passes::pixel_filter_quantile(u.y)};
}

double converge_extent(int number) {
    return 1.0 / std::cbrt(static_cast<double>(number));
}

Settings converge_settings(const Settings& asked, int number, int most_texels) {
    Settings out = asked;
    out.antialias = asked.antialias && number <= k_smoothed_passes;
    out.samples = out.antialias ? 1 : std::clamp(number, 2, k_most_samples);
    out.find_unlit = asked.find_unlit && number == 1;
    if (number == 1) {
        return out;
    }
    const int growth = number >= k_second_growth ? 4 : number >= k_first_growth ? 2 : 1;
    out.shadow_size = std::min(asked.shadow_size * growth, std::max(most_texels, asked.shadow_size));
    out.rsm_size =
        std::min(asked.used_rsm_size() * growth, std::max(k_most_rsm_texels, asked.used_rsm_size()));
    const int sharper = number >= k_second_sharper_maps ? 4 : number >= k_first_sharper_maps ? 2 : 1;
    const int most_map = asked.draws_triangle_maps() ? 1024 : 256;
    out.ism_size = std::min(asked.ism_size * sharper, std::max(most_map, asked.ism_size));
    out.shadow_samples = std::min(asked.used_shadow_samples(), k_places);
    return out;
}

double least_wait_s(double relmse, double target, double seconds) {
    return seconds * std::max(relmse / target - 1.0, 0.0);
}

std::string converge_refusal(const Settings& settings) {
    if (settings.technique != Technique::ism) {
        return {};
    }
    // The world's lights may be drawn by it as well, in later passes even where it is not asked for.
    if (settings.vpl_sampling == VplSampling::metropolis ||
        settings.vpl_sampling == VplSampling::metropolis_unreduced) {
        return fmt::format(
            "--vpl-sampling {} is biased at any length of its chains, and passes would converge to a wrong "
            "picture; give resampled or metropolis-single",
            name_of(settings.vpl_sampling));
    }
    if (settings.vpl_importance == Importance::view && settings.importance_floor == 0.0F) {
        return "with --importance-floor 0 lights that none of the looked-at pixels shows are never drawn, "
               "and "
               "passes would converge to a picture without them; give one above 0";
    }
    return {};
}

Converged converge(Renderer& renderer, const Moment& now, const Settings& settings,
                   const ConvergeTarget& target, gl::TimingMode timing, const std::function<bool()>& stop) {
    assert(settings.samples == 1);
    const Stopwatch watch;
    Converged out;
    GLint most_texels = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most_texels);
    double slowest_ms = 0.0;  // of the last passes
    int next_look = 2;
    for (int number = 1;; ++number) {
        const Stopwatch pass;
        CameraView camera = now.camera;
        camera.offset_px = converge_offset(number);
        FrameReport report = renderer.render_one_of_many(
            now.pose, camera, converge_settings(settings, number, most_texels), timing,
            static_cast<uint32_t>(number), static_cast<float>(converge_extent(number)));
        glFinish();
        if (number == 1) {
            out.report = std::move(report);
        } else {
            add_times(out.report.passes, report.passes);
        }
        slowest_ms = std::max(pass.ms(), 0.7 * slowest_ms);
        const double seconds = watch.ms() / 1000.0;
        const bool late = target.seconds > 0.0 && seconds + slowest_ms / 1000.0 > target.seconds;
        const bool enough = target.passes > 0 && number >= target.passes;
        const bool stopped = stop && stop();
        out.state.passes = number;
        out.state.seconds = seconds;
        const bool last = late || enough || stopped;
        if (!last && (target.relmse <= 0.0 || number < next_look)) {
            continue;
        }
        out.state.relmse = read_picture(renderer, number, out);
        out.state.seconds = watch.ms() / 1000.0;
        if (number > 1) {
            const VarianceBounds bounds = variance_bounds(number);
            out.state.relmse_low = out.state.relmse * bounds.low;
            out.state.relmse_high = out.state.relmse * bounds.high;
        }
        out.history.push_back(out.state);
        next_look = std::max(number + 1, static_cast<int>(k_look_growth * number));
        // Few passes say too little about how they scatter.
        constexpr int k_least_passes = 4;
        if (target.relmse > 0.0 && number >= k_least_passes && out.state.relmse <= target.relmse) {
            out.end = ConvergeEnd::relmse;
            return out;
        }
        // A picture that is not finite has no error, and never will have one.
        if (!last && target.seconds <= 0.0 && target.passes == 0 && number >= k_settled_passes &&
            !(least_wait_s(out.state.relmse, target.relmse, out.state.seconds) <= k_longest_wait_s)) {
            out.end = ConvergeEnd::out_of_reach;
            return out;
        }
        if (last) {
            out.end = stopped ? ConvergeEnd::stopped : late ? ConvergeEnd::seconds : ConvergeEnd::passes;
            return out;
        }
    }
}

std::string describe(const Converged& converged, const ConvergeTarget& target) {
    const ConvergeState& state = converged.state;
    std::string out =
        fmt::format("{} pass{} in {:.2f} s", state.passes, state.passes == 1 ? "" : "es", state.seconds);
    if (state.relmse < 0.0) {
        return out + ": one says nothing about its error";
    }
    out += fmt::format(
        ", estimated relMSE {:.2e} (95 %: {:.1e} to {:.1e}), without what shadow maps of this size miss",
        state.relmse, state.relmse_low, state.relmse_high);
    if (target.relmse > 0.0 && converged.end != ConvergeEnd::relmse) {
        out += fmt::format("; the target of {:.2e} was not reached", target.relmse);
        if (converged.end == ConvergeEnd::out_of_reach) {
            const double wait = least_wait_s(state.relmse, target.relmse, state.seconds);
            out += std::isfinite(wait)
                       ? fmt::format(" and would take {:.0f} more hours at least", std::ceil(wait / 3600.0))
                       : " and cannot be: the error is not a number";
        }
    }
    return out;
}

}  // namespace bounce
