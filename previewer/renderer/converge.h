// SPDX-License-Identifier: Apache-2.0
//
// A picture of one moment that grows better for as long as it is given: the mean of many, each with other
// virtual point lights, points in their shadow maps, parts of the lights a pixel gathers from, and places of
// its pixels.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gl/pass_timer.h"
#include "image/image.h"
#include "renderer/renderer.h"

namespace bounce {

// What ends it; whichever comes first. 0: no matter.
struct ConvergeTarget {
    double seconds = 0.0;  // of wall clock; a pass that would not end in time is not begun
    double relmse = 0.0;   // estimated
    int passes = 0;
};

// How far the picture is after a number of passes.
struct ConvergeState {
    int passes = 0;
    double seconds = 0.0;
    // Estimated relMSE (docs/metrics.md) of the mean against what endless passes would show, and within which
    // bounds it lies with a probability of 95 %. Not in it: what shadow maps of this size miss. Negative: not
    // known, of one pass.
    double relmse = -1.0;
    double relmse_low = -1.0;
    double relmse_high = -1.0;
};

// out_of_reach: an estimated error was the only target, and reaching it would take longer than
// k_longest_wait_s even if the error fell as fast as noise does.
enum class ConvergeEnd { relmse, seconds, passes, stopped, out_of_reach };
constexpr double k_longest_wait_s = 3600.0;

// Seconds until an error of `target` where `relmse` took `seconds`, if it falls as one over the passes: the
// least that it may take. NaN where the error is.
[[nodiscard]] double least_wait_s(double relmse, double target, double seconds);

// Why passes of these settings would not converge to what they are to show; empty where they would.
[[nodiscard]] std::string converge_refusal(const Settings& settings);

struct Converged {
    ConvergeState state;
    ConvergeEnd end = ConvergeEnd::passes;
    FrameReport report;                  // of the first pass, with the passes' times of all together
    Image picture;                       // scene-linear
    size_t faulty_pixels = 0;            // not finite
    std::vector<ConvergeState> history;  // where the error was looked at
};

// Factors by which an estimate of a variance from `samples` values may be off, with a probability of 95 %,
// low and high: quantiles of chi-squared with one degree of freedom less, by Wilson and Hilferty 1931, "The
// Distribution of Chi-Square". samples: 2 or more.
struct VarianceBounds {
    double low = 0.0;
    double high = 0.0;
};
[[nodiscard]] VarianceBounds variance_bounds(int samples);

// Passes that are antialiased, from the first on: each is as good at outlines as several that are not, but
// what a surface shows within a pixel is filtered otherwise than Cycles does it.
constexpr int k_smoothed_passes = 8;

// Where pass `number` (from 1) looks, in pixels from the middle: the first at the middle, the next ones
// around it as far as antialiasing has samples (the filter is in those), the others so that they are Cycles'
// pixel filter. A Sobol sequence each.
[[nodiscard]] glm::dvec2 converge_offset(int number);

// What is left in pass `number` of the surface that bounds a virtual point light's kernel: number^(-1/3).
// What the bounds take from the mean then falls as fast as the noise that they keep out grows, so that both
// vanish (after Knaus and Zwicker 2011, "Progressive Photon Mapping: A Probabilistic Approach").
[[nodiscard]] double converge_extent(int number);

// The settings of pass `number`, from those that were asked for. The first is drawn as a frame by itself,
// with antialiasing. As the noise falls, what maps miss shows: maps that are drawn once (shadow maps and
// reflective ones) grow early, those of virtual point lights, which every pass draws anew, when noise and
// what they miss are about as large. Sizes stay within the driver's limit. Later passes need fewer places on
// lights with a size, since each has its own.
[[nodiscard]] Settings converge_settings(const Settings& asked, int number, int most_texels);

// Draws passes until the target is met or `stop` (called between passes) says so; at least one.
// Settings::samples must be
// 1. Throws like Renderer::render().
[[nodiscard]] Converged converge(Renderer& renderer, const Moment& now, const Settings& settings,
                                 const ConvergeTarget& target, gl::TimingMode timing,
                                 const std::function<bool()>& stop);

// One sentence for people: what was reached, and how surely.
[[nodiscard]] std::string describe(const Converged& converged, const ConvergeTarget& target);

}  // namespace bounce
