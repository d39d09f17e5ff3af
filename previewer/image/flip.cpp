// SPDX-License-Identifier: Apache-2.0
//
// Constants are those of the two papers named in flip.h; symbols in comments are theirs.
#include "image/flip.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <future>
#include <limits>
#include <numbers>
#include <numeric>
#include <thread>
#include <type_traits>
#include <utility>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "image/flip_color.h"
#include "image/srgb.h"

namespace bounce {
namespace {

constexpr float k_pi = std::numbers::pi_v<float>;

// Contrast sensitivity as a sum of two Gaussians a * sqrt(pi/b) * exp(-pi^2 x^2 / b), x in degrees (table 1).
struct Sensitivity {
    float a1, b1, a2, b2;
};
constexpr Sensitivity k_achromatic{1.0F, 0.0047F, 0.0F, 1e-5F};
constexpr Sensitivity k_red_green{1.0F, 0.0053F, 0.0F, 1e-5F};
constexpr Sensitivity k_blue_yellow{34.1F, 0.04F, 13.5F, 0.025F};
constexpr float k_color_exponent = 0.7F;           // q_c
constexpr float k_color_knee = 0.4F;               // p_c, of the largest difference
constexpr float k_error_at_knee = 0.95F;           // p_t
constexpr float k_feature_width_degrees = 0.082F;  // w
constexpr float k_feature_exponent = 0.5F;         // q_f
constexpr float k_exposed_brightness = 0.85F;      // t of HDR-FLIP

// A colour image as three planes.
using Planes = std::array<Plane, 3>;

Kernel gaussian(float b, float pixels_per_degree, int radius) {
    Kernel kernel;
    for (int i = -radius; i <= radius; ++i) {
        const float degrees = static_cast<float>(i) / pixels_per_degree;
        kernel.push_back(std::exp(-k_pi * k_pi * degrees * degrees / b));
    }
    return kernel;
}

float sum(const Kernel& kernel) {
    return std::accumulate(kernel.begin(), kernel.end(), 0.0F);
}

Kernel scaled(Kernel kernel, float factor) {
    for (float& weight : kernel) {
        weight *= factor;
    }
    return kernel;
}

// What the eye resolves of one channel. The two-dimensional kernel is normalised to 1; each of its
// Gaussians is separable, the sum of two is filtered as two.
Plane filter_by_sensitivity(const Plane& plane, const Sensitivity& csf, float pixels_per_degree) {
    // Three standard deviations of the widest Gaussian of all channels.
    const int radius = static_cast<int>(
        std::ceil(3.0F * std::sqrt(k_blue_yellow.b1 / (2.0F * k_pi * k_pi)) * pixels_per_degree));
    const Kernel wide = gaussian(csf.b1, pixels_per_degree, radius);
    const Kernel narrow = gaussian(csf.b2, pixels_per_degree, radius);
    const float weight_wide = csf.a1 * std::sqrt(k_pi / csf.b1);
    const float weight_narrow = csf.a2 * std::sqrt(k_pi / csf.b2);
    const float total = weight_wide * sum(wide) * sum(wide) + weight_narrow * sum(narrow) * sum(narrow);

    Plane result = filter_columns(filter_rows(plane, wide), scaled(wide, weight_wide / total));
    if (csf.a2 != 0.0F) {
        const Plane other = filter_columns(filter_rows(plane, narrow), scaled(narrow, weight_narrow / total));
        std::transform(result.values.begin(), result.values.end(), other.values.begin(),
                       result.values.begin(), std::plus<>());
    }
    return result;
}

// The colour pipeline up to the space in which differences are taken (section 4.1).
std::vector<glm::vec3> perceived_colors(const Planes& ycxcz, float pixels_per_degree) {
    const Plane y = filter_by_sensitivity(ycxcz[0], k_achromatic, pixels_per_degree);
    const Plane cx = filter_by_sensitivity(ycxcz[1], k_red_green, pixels_per_degree);
    const Plane cz = filter_by_sensitivity(ycxcz[2], k_blue_yellow, pixels_per_degree);
    std::vector<glm::vec3> colors(y.values.size());
    for (size_t i = 0; i < colors.size(); ++i) {
        const glm::vec3 linear = flip::linear_from_ycxcz({y.values[i], cx.values[i], cz.values[i]});
        colors[i] = flip::hunt_adjusted(flip::lab_from_linear(glm::clamp(linear, 0.0F, 1.0F)));
    }
    return colors;
}

// Colour difference 0..1: small ones are spread over most of the range (section 4.1.4).
float color_error(const glm::vec3& test, const glm::vec3& reference) {
    static const float largest = std::pow(flip::hyab(flip::hunt_adjusted(flip::lab_from_linear({0, 1, 0})),
                                                     flip::hunt_adjusted(flip::lab_from_linear({0, 0, 1}))),
                                          k_color_exponent);
    const float difference = std::pow(flip::hyab(test, reference), k_color_exponent);
    const float knee = k_color_knee * largest;
    if (difference < knee) {
        return difference * k_error_at_knee / knee;
    }
    return k_error_at_knee + (difference - knee) / (largest - knee) * (1.0F - k_error_at_knee);
}

struct FeatureKernels {
    Kernel smooth, edge, point;
};

// A Gaussian and its first two derivatives; of these, the positive weights sum to 1 and the negative to -1.
FeatureKernels feature_kernels(float pixels_per_degree) {
    const float deviation = 0.5F * k_feature_width_degrees * pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(3.0F * deviation));
    FeatureKernels kernels;
    for (int i = -radius; i <= radius; ++i) {
        const float x = static_cast<float>(i);
        const float g = std::exp(-x * x / (2.0F * deviation * deviation));
        kernels.smooth.push_back(g);
        kernels.edge.push_back(-x * g);
        kernels.point.push_back((x * x / (deviation * deviation) - 1.0F) * g);
    }
    kernels.smooth = scaled(kernels.smooth, 1.0F / sum(kernels.smooth));
    for (Kernel* kernel : {&kernels.edge, &kernels.point}) {
        float positive = 0.0F;
        float negative = 0.0F;
        for (const float weight : *kernel) {
            (weight > 0.0F ? positive : negative) += weight;
        }
        for (float& weight : *kernel) {
            weight /= weight > 0.0F ? positive : -negative;
        }
    }
    return kernels;
}

struct Features {
    Plane edges, points;
};

// Lengths of the edge and point responses of the achromatic channel (section 4.2).
Features detect_features(const Plane& y, const FeatureKernels& kernels) {
    Plane grey = y;
    for (float& value : grey.values) {
        value = (value + 16.0F) / 116.0F;
    }
    const Plane smooth_rows = filter_rows(grey, kernels.smooth);
    const auto length_of = [&](const Kernel& derivative) {
        Plane along_x = filter_columns(filter_rows(grey, derivative), kernels.smooth);
        const Plane along_y = filter_columns(smooth_rows, derivative);
        std::transform(along_x.values.begin(), along_x.values.end(), along_y.values.begin(),
                       along_x.values.begin(), [](float a, float b) { return std::hypot(a, b); });
        return along_x;
    };
    return {length_of(kernels.edge), length_of(kernels.point)};
}

// Of linear RGB, clamped to 0..1 (section 4).
PerceivedImage perceived_linear(const std::vector<glm::vec3>& linear, int width, int height,
                                float pixels_per_degree) {
    Planes planes{Plane(width, height), Plane(width, height), Plane(width, height)};
    for (size_t i = 0; i < linear.size(); ++i) {
        const glm::vec3 ycxcz = flip::ycxcz_from_linear(glm::clamp(linear[i], 0.0F, 1.0F));
        for (int channel = 0; channel < 3; ++channel) {
            planes[static_cast<size_t>(channel)].values[i] = ycxcz[channel];
        }
    }
    Features features = detect_features(planes[0], feature_kernels(pixels_per_degree));
    return {width, height, perceived_colors(planes, pixels_per_degree), std::move(features.edges),
            std::move(features.points)};
}

// The fit to the ACES curve of Narkowicz (2015), its pre-exposure of 0.6 undone: numerator and
// denominator as a x^2 + b x + c.
struct Quadratic {
    float a, b, c;
    [[nodiscard]] float at(float x) const { return (a * x + b) * x + c; }
};
constexpr Quadratic k_aces_numerator{0.6F * 0.6F * 2.51F, 0.6F * 0.03F, 0.0F};
constexpr Quadratic k_aces_denominator{0.6F * 0.6F * 2.43F, 0.6F * 0.59F, 0.14F};

std::vector<glm::vec3> tone_mapped(const Image& linear, float exposure) {
    const float scale = std::exp2(exposure);
    std::vector<glm::vec3> mapped(linear.rgb.size() / 3);
    for (size_t i = 0; i < linear.rgb.size(); ++i) {
        // Past 1e4 the curve is flat to seven digits; without the limit its squares overflow.
        const float value = std::min(std::max(linear.rgb[i] * scale, 0.0F), 1e4F);
        mapped[i / 3][static_cast<int>(i % 3)] = k_aces_numerator.at(value) / k_aces_denominator.at(value);
    }
    return mapped;
}

float exposure_at(const FlipExposures& exposures, int index) {
    return exposures.start + static_cast<float>(index) * (exposures.stop - exposures.start) /
                                 static_cast<float>(exposures.count - 1);
}

// The picture as HDR-FLIP sees it at one of the exposures.
PerceivedImage perceived_exposed(const Image& linear, const FlipExposures& exposures, int index,
                                 float pixels_per_degree) {
    return perceived_linear(tone_mapped(linear, exposure_at(exposures, index)), linear.width, linear.height,
                            pixels_per_degree);
}

// act(first, stride) for each of as many threads as there are processors, at most count: together they have
// all indices below count.
template <typename Act>
auto in_strides(int count, const Act& act) {
    const int workers = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, count);
    std::vector<std::future<std::invoke_result_t<Act, int, int>>> parts;
    parts.reserve(static_cast<size_t>(workers));
    for (int first = 0; first < workers; ++first) {
        parts.push_back(std::async(std::launch::async, act, first, workers));
    }
    return parts;
}

void take_larger(Plane& largest, const Plane& error) {
    std::transform(largest.values.begin(), largest.values.end(), error.values.begin(), largest.values.begin(),
                   [](float a, float b) { return std::max(a, b); });
}

// The largest error of each pixel over the exposures. They are independent and the maximum does not depend on
// their order, and so not on the number of threads.
template <typename ErrorAt>
Plane largest_error(int width, int height, int exposures, const ErrorAt& error_at) {
    Plane result(width, height);
    for (auto& part : in_strides(exposures, [&](int first, int stride) {
             Plane largest(width, height);
             for (int index = first; index < exposures; index += stride) {
                 take_larger(largest, error_at(index));
             }
             return largest;
         })) {
        take_larger(result, part.get());
    }
    return result;
}

}  // namespace

PerceivedImage perceived(const Image& display, float pixels_per_degree) {
    std::vector<glm::vec3> linear(display.rgb.size() / 3);
    for (size_t i = 0; i < display.rgb.size(); ++i) {
        linear[i / 3][static_cast<int>(i % 3)] = linear_from_srgb(std::clamp(display.rgb[i], 0.0F, 1.0F));
    }
    return perceived_linear(linear, display.width, display.height, pixels_per_degree);
}

Plane flip_ldr(const PerceivedImage& test, const PerceivedImage& reference) {
    assert(test.width == reference.width && test.height == reference.height);
    Plane error(test.width, test.height);
    for (size_t i = 0; i < error.values.size(); ++i) {
        const float edge = std::abs(test.edges.values[i] - reference.edges.values[i]);
        const float point = std::abs(test.points.values[i] - reference.points.values[i]);
        const float feature =
            std::pow(std::max(edge, point) / std::numbers::sqrt2_v<float>, k_feature_exponent);
        error.values[i] = std::pow(color_error(test.colors[i], reference.colors[i]),
                                   1.0F - std::clamp(feature, 0.0F, 1.0F));
    }
    return error;
}

Plane flip_ldr(const Image& test_display, const Image& reference_display, float pixels_per_degree) {
    return flip_ldr(perceived(test_display, pixels_per_degree),
                    perceived(reference_display, pixels_per_degree));
}

FlipExposures flip_exposures(const Image& reference_linear) {
    std::vector<float> luminances(reference_linear.rgb.size() / 3);
    for (size_t i = 0; i < luminances.size(); ++i) {
        const float* rgb = &reference_linear.rgb[3 * i];
        luminances[i] = 0.2126F * rgb[0] + 0.7152F * rgb[1] + 0.0722F * rgb[2];
    }
    const auto middle = luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() / 2);
    std::nth_element(luminances.begin(), middle, luminances.end());
    const float brightest = *std::max_element(luminances.begin(), luminances.end());
    if (!(brightest > 0.0F)) {
        return {0.0F, 0.0F, 2};  // a black reference: as it is
    }
    // Where more than half of the reference is black the papers' stop is infinite; 16 stops below the
    // brightest pixel is as far as a half float's precision and a screen's range reach.
    const float median = std::max(*middle, brightest * 0x1p-16F);
    // The value that the curve takes to k_exposed_brightness: the positive root of numerator - t denominator.
    const float a = k_aces_numerator.a - k_exposed_brightness * k_aces_denominator.a;
    const float b = k_aces_numerator.b - k_exposed_brightness * k_aces_denominator.b;
    const float c = k_aces_numerator.c - k_exposed_brightness * k_aces_denominator.c;
    const float bright = (-b + std::sqrt(b * b - 4.0F * a * c)) / (2.0F * a);

    FlipExposures exposures;
    exposures.start = std::log2(bright / brightest);
    exposures.stop = std::log2(bright / median);
    exposures.count = std::max(2, static_cast<int>(std::ceil(exposures.stop - exposures.start)));
    return exposures;
}

Plane flip_hdr(const Image& test_linear, const Image& reference_linear, float pixels_per_degree) {
    assert(test_linear.width == reference_linear.width && test_linear.height == reference_linear.height);
    const FlipExposures exposures = flip_exposures(reference_linear);
    return largest_error(test_linear.width, test_linear.height, exposures.count, [&](int index) {
        return flip_ldr(perceived_exposed(test_linear, exposures, index, pixels_per_degree),
                        perceived_exposed(reference_linear, exposures, index, pixels_per_degree));
    });
}

HdrFlipReference::HdrFlipReference(const Image& reference_linear, float pixels_per_degree)
    : exposures_(flip_exposures(reference_linear)), pixels_per_degree_(pixels_per_degree) {
    perceived_.resize(static_cast<size_t>(exposures_.count));
    for (auto& part : in_strides(exposures_.count, [&](int first, int stride) {
             for (int index = first; index < exposures_.count; index += stride) {
                 perceived_[static_cast<size_t>(index)] =
                     perceived_exposed(reference_linear, exposures_, index, pixels_per_degree);
             }
         })) {
        part.get();
    }
}

Plane HdrFlipReference::error_of(const Image& test_linear) const {
    return largest_error(test_linear.width, test_linear.height, exposures_.count, [&](int index) {
        return flip_ldr(perceived_exposed(test_linear, exposures_, index, pixels_per_degree_),
                        perceived_[static_cast<size_t>(index)]);
    });
}

double mean(const Plane& plane) {
    return std::accumulate(plane.values.begin(), plane.values.end(), 0.0) /
           static_cast<double>(plane.values.size());
}

}  // namespace bounce
