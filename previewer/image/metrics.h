// SPDX-License-Identifier: Apache-2.0
//
// How far an image is from a reference; the definitions in words are in docs/metrics.md.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "image/flip.h"
#include "image/image.h"

namespace bounce {

// a is the image's value, b the reference's, both scene-linear; means run over all pixels and channels.
// Where either image has a NaN or infinite value every error is NaN: an average over the rest would
// look better than the picture is.
struct Metrics {
    double relmse = 0.0;          // mean of (a - b)^2 / (b^2 + 0.01)
    double relmse_exposed = 0.0;  // relmse after both are scaled so that the mean of b is 0.18
    double nrmse = 0.0;           // sqrt(mean of (a - b)^2) / sqrt(mean of b^2)
    double smape = 0.0;           // mean of |a - b| / (|a| + |b| + 0.01)
    double psnr_db = 0.0;         // after the Standard view transform; infinite for equal images
    double ssim = 0.0;            // after it, on luma
    double flip_ldr = 0.0;        // after it
    double flip_hdr = 0.0;
    double bias = 0.0;  // mean(a) / mean(b) - 1
    std::array<double, 3> bias_rgb{};
    double max_abs = 0.0;  // largest |a - b|, and the pixel (column, row from the top) it is at
    int max_abs_x = 0;
    int max_abs_y = 0;
    size_t nan = 0;  // values (channels of pixels) that are NaN, in both images together
    size_t inf = 0;
    int width = 0;
    int height = 0;
    float flip_hdr_start_exposure = 0.0F;  // stops
    float flip_hdr_stop_exposure = 0.0F;
    int flip_hdr_exposures = 0;
};

// HDR-FLIP takes most of the time of a comparison; left out, it is NaN.
enum class HdrFlip { compute, leave_out };

// A picture as what follows the view transform sees it: made once for one that is compared several times.
struct DisplayedImage {
    Image display;
    PerceivedImage perceived;
};
[[nodiscard]] DisplayedImage displayed(const Image& scene_linear);

// Throws input_error where the sizes differ.
[[nodiscard]] Metrics compare(const Image& test, const Image& reference, HdrFlip hdr_flip = HdrFlip::compute);
// The same, with what displayed() made of both.
[[nodiscard]] Metrics compare(const Image& test, const DisplayedImage& test_displayed, const Image& reference,
                              const DisplayedImage& reference_displayed, HdrFlip hdr_flip);

// relMSE alone, in the time it takes to read the pixels: mean of (a - b)^2 / (b^2 + 0.01). Rousselle,
// Knaus and Zwicker, 2011, "Adaptive sampling and reconstruction using greedy error minimization". NaN
// where a value is not finite.
[[nodiscard]] double relmse(const Image& test, const Image& reference, double scale = 1.0);

// Structural similarity of one channel, 1 for equal planes: 11 x 11 Gaussian window (1.5 px), K1 0.01,
// K2 0.03, range 1, mean over the windows that lie inside (a plane smaller than the window is taken
// whole). Wang, Bovik, Sheikh and Simoncelli, 2004, "Image quality assessment: from error visibility to
// structural similarity".
[[nodiscard]] double ssim(const Plane& test, const Plane& reference);

// Rec. 709's weighted sum of the channels: luma of a display-referred image, luminance of a linear one.
[[nodiscard]] Plane luma(const Image& image);

// A metric by its name in the JSON, for thresholds.
struct NamedMetric {
    std::string_view name;
    bool lower_is_better;  // false: psnr_db, ssim
    double (*value)(const Metrics&);
};
[[nodiscard]] const std::vector<NamedMetric>& named_metrics();
[[nodiscard]] std::optional<NamedMetric> find_metric(std::string_view name);

// True where the metric is above the limit (bias: its magnitude) or cannot be told because a value is
// NaN or infinite.
[[nodiscard]] bool exceeds(const Metrics& metrics, const NamedMetric& metric, double limit);

}  // namespace bounce
