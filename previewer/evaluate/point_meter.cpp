// SPDX-License-Identifier: Apache-2.0
#include "evaluate/point_meter.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "core/log.h"
#include "image/image_io.h"
#include "image/metrics.h"
#include "image/sequence_metrics.h"

namespace bounce {
namespace {

FrameError error_of(const RenderedFrame& frame, const Metrics& metrics) {
    if (metrics.nan + metrics.inf > 0) {
        log::warning("frame {}: {} values are NaN and {} infinite, so its errors are not numbers",
                     frame.frame, metrics.nan, metrics.inf);
    }
    FrameError error;
    error.frame = frame.frame;
    error.seconds = frame.seconds;
    error.relmse = metrics.relmse;
    error.relmse_exposed = metrics.relmse_exposed;
    error.flip_ldr = metrics.flip_ldr;
    error.ssim = metrics.ssim;
    error.psnr_db = metrics.psnr_db;
    error.bias = metrics.bias;
    error.nrmse = metrics.nrmse;
    error.smape = metrics.smape;
    error.bias_rgb = metrics.bias_rgb;
    error.max_abs = metrics.max_abs;
    error.max_x = metrics.max_abs_x;
    error.max_y = metrics.max_abs_y;
    error.not_finite = metrics.nan + metrics.inf;
    if (frame.all_seconds.size() > 1) {  // of one alone there is no spread
        const auto [least, most] = std::minmax_element(frame.all_seconds.begin(), frame.all_seconds.end());
        error.seconds_least = *least;
        error.seconds_most = *most;
    }
    return error;
}

}  // namespace

Image RenderedFrame::image() const {
    return held != nullptr ? *held : read_image(file);
}

CurvePoint measure_point(std::string label, const std::vector<RenderedFrame>& frames,
                         const ReferenceImage& reference, const MotionLayers& motion) {
    std::vector<int> numbers;
    std::transform(frames.begin(), frames.end(), std::back_inserter(numbers),
                   [](const RenderedFrame& frame) { return frame.frame; });
    const bool sequence = even_step(numbers) > 0;
    SequenceMeter meter;
    std::vector<FrameError> errors;
    for (const RenderedFrame& frame : frames) {
        const Image image = frame.image();
        const Image& target = reference(frame.frame);
        if (sequence) {
            const std::optional<Image> layer = motion.of(frame.frame);
            errors.push_back(
                error_of(frame, *meter.add(frame.frame, image, &target, layer ? &*layer : nullptr).error));
        } else {
            errors.push_back(error_of(frame, compare(image, target, HdrFlip::leave_out)));
        }
    }
    CurvePoint point = make_point(std::move(label), std::move(errors));
    if (sequence) {
        point.sequence = meter.finish();
    }
    return point;
}

FinalErrors errors_against(const std::vector<RenderedFrame>& frames, const ReferenceImage& target) {
    FinalErrors mean;
    const double share = 1.0 / static_cast<double>(frames.size());
    for (const RenderedFrame& frame : frames) {
        const Metrics metrics = compare(frame.image(), target(frame.frame), HdrFlip::leave_out);
        mean.relmse += share * metrics.relmse;
        mean.flip_ldr += share * metrics.flip_ldr;
        mean.ssim += share * metrics.ssim;
        mean.psnr_db += share * metrics.psnr_db;
        mean.bias += share * metrics.bias;
    }
    return mean;
}

}  // namespace bounce
