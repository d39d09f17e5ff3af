// SPDX-License-Identifier: Apache-2.0
//
// Error against run time as plain data, and what follows from it. No files, no processes.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "image/sequence_metrics.h"

namespace bounce {

// One frame rendered one way, against its reference.
struct FrameError {
    int frame = 1;
    double seconds = 0.0;  // steady state
    double relmse = 0.0;
    double relmse_exposed = 0.0;
    double flip_ldr = 0.0;
    double ssim = 0.0;
    double psnr_db = 0.0;
    double bias = 0.0;
    double nrmse = 0.0;
    double smape = 0.0;
    std::array<double, 3> bias_rgb{};
    double max_abs = 0.0;  // the worst pixel's, and where it is from the top left
    int max_x = 0;
    int max_y = 0;
    size_t not_finite = 0;
    // Filled in later, and not for every point (hdr_flip_of_points.h); NaN where it is left out.
    double flip_hdr = std::numeric_limits<double>::quiet_NaN();
    // Fastest and slowest of the repeated renders; NaN where only one time is known.
    double seconds_least = std::numeric_limits<double>::quiet_NaN();
    double seconds_most = std::numeric_limits<double>::quiet_NaN();
};

// Against the scene as Cycles renders it by the scene's own light paths: means over the frames.
struct FinalErrors {
    double relmse = 0.0;
    double flip_ldr = 0.0;
    double ssim = 0.0;
    double psnr_db = 0.0;
    double bias = 0.0;
};

// One way of rendering: means over its frames.
struct CurvePoint {
    std::string label;
    double seconds = 0.0;
    double setup_seconds = 0.0;    // of these, before the first sample; 0 where not told apart
    double startup_seconds = 0.0;  // once a run, not part of seconds
    double relmse = 0.0;
    double relmse_exposed = 0.0;
    double flip_ldr = 0.0;
    double ssim = 0.0;
    double psnr_db = 0.0;  // mean of the frames' decibels
    double bias = 0.0;
    double nrmse = 0.0;
    double smape = 0.0;
    std::array<double, 3> bias_rgb{};
    double flip_hdr = std::numeric_limits<double>::quiet_NaN();  // NaN where a frame has none
    std::optional<SequenceMetrics> sequence;  // where the frames are one; its errors are those of frames
    std::optional<FinalErrors> final_errors;  // where they were asked for
    bool pareto = false;
    size_t rss_peak_bytes = 0;  // of the process; 0 where not known
    size_t gl_peak_bytes = 0;   // of buffers and textures in OpenGL; 0 where not known
    std::string measured;       // when, where an earlier run has measured it; else empty
    std::vector<FrameError> frames;
    // Means of the frames' least and most; NaN where not known.
    double seconds_least = std::numeric_limits<double>::quiet_NaN();
    double seconds_most = std::numeric_limits<double>::quiet_NaN();
    std::vector<std::string> options;  // of `bounce render`; empty where Bounce did not draw the point
    bool own_front = false;            // on the front of Bounce's own points
};

struct Curve {
    std::string name;
    bool reference_engine = false;  // the ladder that others are measured against
    std::vector<CurvePoint> points;
    bool peer = false;  // another engine than Bounce and the reference's
};

// Arithmetic mean of a figure over the frames, of which there is at least one.
[[nodiscard]] double mean_of_frames(const std::vector<FrameError>& frames, double FrameError::*figure);

// A point from its frames: arithmetic means. Needs at least one frame.
[[nodiscard]] CurvePoint make_point(std::string label, std::vector<FrameError> frames);

// For each point whether no other is at least as fast and as exact, and better in one of both. A point
// whose time or error is not a number is never on the front.
[[nodiscard]] std::vector<bool> pareto_front(const std::vector<std::pair<double, double>>& seconds_and_error);

// Sets CurvePoint::pareto over all curves together and own_front over the points that Bounce drew, by relMSE.
void mark_pareto(std::vector<Curve>& curves);

enum class EqualErrorKind {
    interpolated,   // between two points of the ladder
    extrapolated,   // beyond its most exact point, along the slope of its last segment
    fastest_point,  // the ladder's fastest point is already at least as exact
};

// As results.json and results.csv call it.
[[nodiscard]] std::string equal_error_name(EqualErrorKind kind);

struct EqualError {
    double seconds = 0.0;
    EqualErrorKind kind = EqualErrorKind::interpolated;
};

// The time at which the ladder (seconds, error; any order) reaches the error, by straight lines between
// the logarithms of the points on its own Pareto front. Beyond the last of them the last segment goes on, but
// not flatter than error times time is constant. Nothing where the ladder has fewer than two usable points,
// where the error is not positive, or where the ladder does not get better with time.
[[nodiscard]] std::optional<EqualError> time_at_error(std::vector<std::pair<double, double>> ladder,
                                                      double error);

struct Speedup {
    std::string curve;
    std::string label;
    double relmse = 0.0;
    double bounce_seconds = 0.0;
    double cycles_seconds = 0.0;
    double ratio = 0.0;  // cycles_seconds / bounce_seconds
    EqualErrorKind kind = EqualErrorKind::interpolated;
};

// Every point of Bounce's curves against the ladder of the reference engine.
[[nodiscard]] std::vector<Speedup> speedups_at_equal_error(const std::vector<Curve>& curves);

// One scene in a line: the front of Bounce's own points against Cycles. Bounce's own, because on the common
// front only those points remain that Cycles does not beat, which would flatter.
struct FrontSummary {
    size_t points = 0;        // on the front
    size_t compared = 0;      // of these, with a time to equal error
    size_t extrapolated = 0;  // of the compared: beyond Cycles' most exact point
    size_t upper_bounds =
        0;  // of the compared: Cycles' fastest is already as exact, the ratio is at most this
    double geometric_mean_ratio = 0.0;  // Cycles' time over Bounce's; NaN where none is compared
    double least_ratio = 0.0;           // NaN as well
    std::string least_curve, least_label;
};

// Needs mark_pareto() before.
[[nodiscard]] FrontSummary summarize_front(const std::vector<Curve>& curves,
                                           const std::vector<Speedup>& speedups);

}  // namespace bounce
