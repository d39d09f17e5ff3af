// SPDX-License-Identifier: Apache-2.0
#include "image/metrics.h"

#include <cmath>
#include <future>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "image/view_transform.h"

namespace bounce {
namespace {

// Keeps the relative error of black pixels finite; the value every published relMSE here uses.
constexpr double k_relative_epsilon = 0.01;
constexpr double k_middle_grey = 0.18;

void require_same_size(const Image& test, const Image& reference) {
    if (test.width != reference.width || test.height != reference.height) {
        throw input_error(
            fmt::format("the image is {}x{} but the reference is {}x{}; render both at one size", test.width,
                        test.height, reference.width, reference.height));
    }
}

void count_not_finite(const Image& image, Metrics& metrics) {
    for (const float value : image.rgb) {
        metrics.nan += std::isnan(value) ? 1U : 0U;
        metrics.inf += std::isinf(value) ? 1U : 0U;
    }
}

// a/b - 1, where 0/0 is no difference.
double relative_difference(double a, double b) {
    return a == b ? 0.0 : a / b - 1.0;
}

void fill_linear(const Image& test, const Image& reference, Metrics& metrics) {
    double squared_error = 0.0;
    double squared_reference = 0.0;
    double absolute_relative = 0.0;
    std::array<double, 3> test_sum{};
    std::array<double, 3> reference_sum{};
    size_t worst = 0;
    for (size_t i = 0; i < test.rgb.size(); ++i) {
        const double a = test.rgb[i];
        const double b = reference.rgb[i];
        const double difference = std::abs(a - b);
        squared_error += difference * difference;
        squared_reference += b * b;
        absolute_relative += difference / (std::abs(a) + std::abs(b) + k_relative_epsilon);
        test_sum[i % 3] += a;
        reference_sum[i % 3] += b;
        if (difference > metrics.max_abs) {
            metrics.max_abs = difference;
            worst = i / 3;
        }
    }
    const auto count = static_cast<double>(test.rgb.size());
    const auto width = static_cast<size_t>(test.width);
    metrics.max_abs_x = static_cast<int>(worst % width);
    metrics.max_abs_y = static_cast<int>(worst / width);
    metrics.nrmse = squared_error == 0.0 ? 0.0 : std::sqrt(squared_error / squared_reference);
    metrics.smape = absolute_relative / count;
    for (size_t channel = 0; channel < 3; ++channel) {
        metrics.bias_rgb[channel] = relative_difference(test_sum[channel], reference_sum[channel]);
    }
    const double reference_total = reference_sum[0] + reference_sum[1] + reference_sum[2];
    metrics.bias = relative_difference(test_sum[0] + test_sum[1] + test_sum[2], reference_total);
    metrics.relmse = relmse(test, reference);
    // A reference without light has no exposure to be brought to.
    const double scale = reference_total > 0.0 ? k_middle_grey / (reference_total / count) : 1.0;
    metrics.relmse_exposed = relmse(test, reference, scale);
}

double psnr_db(const Image& test_display, const Image& reference_display) {
    double squared_error = 0.0;
    for (size_t i = 0; i < test_display.rgb.size(); ++i) {
        const double difference = static_cast<double>(test_display.rgb[i]) - reference_display.rgb[i];
        squared_error += difference * difference;
    }
    return -10.0 * std::log10(squared_error / static_cast<double>(test_display.rgb.size()));
}

void fill_nan(Metrics& metrics) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (double* value :
         {&metrics.relmse, &metrics.relmse_exposed, &metrics.nrmse, &metrics.smape, &metrics.psnr_db,
          &metrics.ssim, &metrics.flip_ldr, &metrics.flip_hdr, &metrics.bias, &metrics.max_abs}) {
        *value = nan;
    }
    metrics.bias_rgb.fill(nan);
}

}  // namespace

double relmse(const Image& test, const Image& reference, double scale) {
    require_same_size(test, reference);
    double sum = 0.0;
    for (size_t i = 0; i < test.rgb.size(); ++i) {
        const double a = scale * test.rgb[i];
        const double b = scale * reference.rgb[i];
        sum += (a - b) * (a - b) / (b * b + k_relative_epsilon);
    }
    const double result = sum / static_cast<double>(test.rgb.size());
    return std::isfinite(result) ? result : std::numeric_limits<double>::quiet_NaN();
}

Plane luma(const Image& image) {
    Plane plane(image.width, image.height);
    for (size_t i = 0; i < plane.values.size(); ++i) {
        const float* rgb = &image.rgb[3 * i];
        plane.values[i] = 0.2126F * rgb[0] + 0.7152F * rgb[1] + 0.0722F * rgb[2];
    }
    return plane;
}

DisplayedImage displayed(const Image& scene_linear) {
    Image display = to_display(scene_linear, {});
    PerceivedImage perceived_display = perceived(display);
    return {std::move(display), std::move(perceived_display)};
}

Metrics compare(const Image& test, const Image& reference, HdrFlip hdr_flip) {
    auto reference_displayed = std::async(std::launch::async, [&reference] { return displayed(reference); });
    const DisplayedImage test_displayed = displayed(test);
    return compare(test, test_displayed, reference, reference_displayed.get(), hdr_flip);
}

Metrics compare(const Image& test, const DisplayedImage& test_displayed, const Image& reference,
                const DisplayedImage& reference_displayed, HdrFlip hdr_flip) {
    require_same_size(test, reference);
    Metrics metrics;
    metrics.width = test.width;
    metrics.height = test.height;
    count_not_finite(test, metrics);
    count_not_finite(reference, metrics);
    if (metrics.nan + metrics.inf > 0) {
        fill_nan(metrics);
        return metrics;
    }
    fill_linear(test, reference, metrics);
    metrics.psnr_db = psnr_db(test_displayed.display, reference_displayed.display);
    metrics.ssim = ssim(luma(test_displayed.display), luma(reference_displayed.display));
    metrics.flip_ldr = mean(flip_ldr(test_displayed.perceived, reference_displayed.perceived));
    if (hdr_flip == HdrFlip::leave_out) {
        metrics.flip_hdr = std::numeric_limits<double>::quiet_NaN();
        return metrics;
    }
    metrics.flip_hdr = mean(flip_hdr(test, reference));
    const FlipExposures exposures = flip_exposures(reference);
    metrics.flip_hdr_start_exposure = exposures.start;
    metrics.flip_hdr_stop_exposure = exposures.stop;
    metrics.flip_hdr_exposures = exposures.count;
    return metrics;
}

const std::vector<NamedMetric>& named_metrics() {
    static const std::vector<NamedMetric> metrics{
        {"relmse", true, [](const Metrics& m) { return m.relmse; }},
        {"relmse_exposed", true, [](const Metrics& m) { return m.relmse_exposed; }},
        {"nrmse", true, [](const Metrics& m) { return m.nrmse; }},
        {"smape", true, [](const Metrics& m) { return m.smape; }},
        {"psnr_db", false, [](const Metrics& m) { return m.psnr_db; }},
        {"ssim", false, [](const Metrics& m) { return m.ssim; }},
        {"flip_ldr", true, [](const Metrics& m) { return m.flip_ldr; }},
        {"flip_hdr", true, [](const Metrics& m) { return m.flip_hdr; }},
        {"bias", true, [](const Metrics& m) { return m.bias; }},
        {"max_abs", true, [](const Metrics& m) { return m.max_abs; }},
        {"nan", true, [](const Metrics& m) { return static_cast<double>(m.nan); }},
        {"inf", true, [](const Metrics& m) { return static_cast<double>(m.inf); }},
    };
    return metrics;
}

std::optional<NamedMetric> find_metric(std::string_view name) {
    for (const NamedMetric& metric : named_metrics()) {
        if (metric.name == name) {
            return metric;
        }
    }
    return std::nullopt;
}

bool exceeds(const Metrics& metrics, const NamedMetric& metric, double limit) {
    // Negated, so that NaN counts as above.
    return metrics.nan + metrics.inf > 0 || !(std::abs(metric.value(metrics)) <= limit);
}

}  // namespace bounce
