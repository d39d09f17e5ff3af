// SPDX-License-Identifier: Apache-2.0
#include "image/sequence_metrics.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "image/temporal_spectrum.h"

namespace bounce {
namespace {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

void require_size(const Image& image, const char* which, int frame, int width, int height) {
    if (image.width != width || image.height != height) {
        throw input_error(fmt::format(
            "the {} of frame {} is {}x{} but the sequence began with {}x{}; render all at one size", which,
            frame, image.width, image.height, width, height));
    }
}

void count_not_finite(const Image* image, SequenceFrame& entry) {
    if (image == nullptr) {
        return;
    }
    for (const float value : image->rgb) {
        entry.nan += std::isnan(value) ? 1U : 0U;
        entry.inf += std::isinf(value) ? 1U : 0U;
    }
}

Plane difference(const Plane& a, const Plane* b) {
    Plane out = a;
    if (b != nullptr) {
        for (size_t i = 0; i < out.values.size(); ++i) {
            out.values[i] -= b->values[i];
        }
    }
    return out;
}

double root_mean(const ReprojectedDifference& sums) {
    return sums.matched > 0 ? std::sqrt(sums.squared / static_cast<double>(sums.matched)) : k_nan;
}

// a/b, where 0/0 is nothing of nothing.
double ratio(double a, double b) {
    return a == 0.0 ? 0.0 : a / b;
}

// Mean and largest of the steps, and the frame of the largest. NaN stays NaN.
void fill_steps(SequenceMetrics& out) {
    double sum = 0.0;
    double reference_sum = 0.0;
    out.flip_step_max = out.flip_step_reference_max = 0.0;
    for (size_t i = 1; i < out.frames.size(); ++i) {
        const SequenceFrame& entry = out.frames[i];
        sum += entry.flip_step;
        reference_sum += entry.flip_step_reference;
        if (!(entry.flip_step <= out.flip_step_max)) {
            out.flip_step_max = entry.flip_step;
            out.flip_step_max_frame = entry.frame;
        }
        out.flip_step_reference_max = std::max(out.flip_step_reference_max, entry.flip_step_reference);
    }
    const auto steps = static_cast<double>(out.frames.size()) - 1.0;
    out.flip_step_mean = sum / steps;
    out.flip_step_reference_mean = reference_sum / steps;
    if (std::isnan(out.flip_step_reference_mean)) {
        out.flip_step_reference_max = k_nan;
    }
}

void fill_nan(SequenceMetrics& out) {
    for (double* value :
         {&out.mean_luminance, &out.flip_step_mean, &out.flip_step_max, &out.flip_step_reference_mean,
          &out.flip_step_reference_max, &out.tid, &out.tid_relative, &out.tid_reference, &out.tid_coverage,
          &out.flicker_power, &out.flicker_share, &out.flicker_pixels}) {
        *value = k_nan;
    }
}

}  // namespace

int even_step(const std::vector<int>& frames) {
    if (frames.size() < 2) {
        return 0;
    }
    const int step = frames[1] - frames[0];
    const auto uneven = std::adjacent_find(frames.begin(), frames.end(),
                                           [&](int before, int frame) { return frame - before != step; });
    return step > 0 && uneven == frames.end() ? step : 0;
}

void SequenceMeter::add_steps(SequenceFrame& entry, const Image& test, PerceivedImage test_perceived,
                              const Image* reference, PerceivedImage reference_perceived,
                              const Image* motion) {
    Plane luminance = luma(test);
    const bool later = !metrics_.frames.empty();
    entry.flip_step = later ? mean(flip_ldr(test_perceived, perceived_)) : k_nan;
    entry.flip_step_reference = entry.tid = k_nan;
    if (later && motion != nullptr) {
        const ReprojectedDifference sums = reprojected_difference(luminance, luminance_, *motion);
        entry.tid = root_mean(sums);
        all_ += sums;
        keep_still_pixels(*motion, still_);
        ++with_motion_;
    }
    if (reference != nullptr) {
        Plane reference_luminance = luma(*reference);
        if (later) {
            entry.flip_step_reference = mean(flip_ldr(reference_perceived, reference_perceived_));
            if (motion != nullptr) {
                all_reference_ += reprojected_difference(reference_luminance, reference_luminance_, *motion);
            }
        }
        reference_perceived_ = std::move(reference_perceived);
        reference_luminance_ = std::move(reference_luminance);
    }
    perceived_ = std::move(test_perceived);
    luminance_ = std::move(luminance);
    luminance_sum_ += mean(reference != nullptr ? reference_luminance_ : luminance_);
    signals_.push_back(difference(luminance_, reference != nullptr ? &reference_luminance_ : nullptr));
}

const SequenceFrame& SequenceMeter::add(int frame, const Image& test, const Image* reference,
                                        const Image* motion) {
    const bool first = metrics_.frames.empty();
    if (first) {
        metrics_.width = test.width;
        metrics_.height = test.height;
        still_.assign(test.rgb.size() / 3, 1);
    }
    require_size(test, "image", frame, metrics_.width, metrics_.height);
    if (reference != nullptr) {
        require_size(*reference, "reference", frame, metrics_.width, metrics_.height);
    }
    if (motion != nullptr) {
        require_size(*motion, "motion", frame, metrics_.width, metrics_.height);
    } else if (with_motion_ > 0) {
        throw input_error(fmt::format("frame {} has no motion but the frames before it have", frame));
    }
    SequenceFrame entry;
    entry.frame = frame;
    count_not_finite(&test, entry);
    count_not_finite(reference, entry);
    count_not_finite(motion, entry);
    metrics_.nan += entry.nan;
    metrics_.inf += entry.inf;
    // Looked at once for the error and for the steps to both neighbours.
    auto reference_displayed = std::async(std::launch::async, [reference] {
        return reference != nullptr ? displayed(*reference) : DisplayedImage{};
    });
    DisplayedImage test_displayed = displayed(test);
    DisplayedImage seen_reference = reference_displayed.get();
    if (reference != nullptr) {
        entry.error = compare(test, test_displayed, *reference, seen_reference, hdr_flip_);
    }
    // Past the first value that is not finite the whole has no figure that could be told.
    if (metrics_.nan + metrics_.inf == 0) {
        add_steps(entry, test, std::move(test_displayed.perceived), reference,
                  std::move(seen_reference.perceived), motion);
    } else {
        entry.flip_step = entry.flip_step_reference = entry.tid = k_nan;
    }
    metrics_.frames.push_back(std::move(entry));
    return metrics_.frames.back();
}

void SequenceMeter::fill_tid(SequenceMetrics& out) const {
    const bool complete = with_motion_ > 0 && with_motion_ + 1 == out.frames.size();
    out.tid = complete ? root_mean(all_) : k_nan;
    out.tid_relative = ratio(out.tid, out.mean_luminance);
    out.tid_reference = complete ? root_mean(all_reference_) : k_nan;
    out.tid_coverage = complete ? static_cast<double>(all_.matched) /
                                      (static_cast<double>(with_motion_) * static_cast<double>(still_.size()))
                                : k_nan;
}

SequenceMetrics SequenceMeter::finish() {
    SequenceMetrics out = metrics_;
    if (out.nan + out.inf > 0) {
        fill_nan(out);
        return out;
    }
    out.mean_luminance = luminance_sum_ / static_cast<double>(out.frames.size());
    fill_steps(out);
    fill_tid(out);
    const bool against = out.frames.front().error.has_value();
    const bool still_only = !against && with_motion_ > 0;
    const TemporalEnergy energy = mean_temporal_energy(signals_, still_only ? still_ : std::vector<char>{});
    out.flicker_power = ratio(energy.high, out.mean_luminance * out.mean_luminance);
    out.flicker_share = ratio(energy.high, energy.total);
    out.flicker_pixels = still_only ? static_cast<double>(std::count(still_.begin(), still_.end(), 1)) /
                                          static_cast<double>(still_.size())
                                    : 1.0;
    return out;
}

const std::vector<NamedSequenceMetric>& named_sequence_metrics() {
    constexpr std::string_view motion = "needs --motion";
    constexpr std::string_view frames = "needs 8 frames or more, and pixels that stand still";
    static const std::vector<NamedSequenceMetric> metrics{
        {"flip_step_mean", [](const SequenceMetrics& m) { return m.flip_step_mean; }, ""},
        {"flip_step_max", [](const SequenceMetrics& m) { return m.flip_step_max; }, ""},
        {"tid", [](const SequenceMetrics& m) { return m.tid; }, motion},
        {"tid_relative", [](const SequenceMetrics& m) { return m.tid_relative; }, motion},
        {"flicker_power", [](const SequenceMetrics& m) { return m.flicker_power; }, frames},
        {"flicker_share", [](const SequenceMetrics& m) { return m.flicker_share; }, frames},
    };
    return metrics;
}

std::optional<NamedSequenceMetric> find_sequence_metric(std::string_view name) {
    for (const NamedSequenceMetric& metric : named_sequence_metrics()) {
        if (metric.name == name) {
            return metric;
        }
    }
    return std::nullopt;
}

const SequenceFrame* worst_frame(const SequenceMetrics& metrics, const NamedMetric& metric) {
    const SequenceFrame* worst = nullptr;
    const auto badness = [&](const SequenceFrame& entry) {
        const double value = metric.value(*entry.error);
        return metric.lower_is_better ? std::abs(value) : -value;
    };
    for (const SequenceFrame& entry : metrics.frames) {
        if (!entry.error) {
            return nullptr;
        }
        if (worst == nullptr || (!(badness(entry) <= badness(*worst)) && !std::isnan(badness(*worst)))) {
            worst = &entry;
        }
    }
    return worst;
}

}  // namespace bounce
