// SPDX-License-Identifier: Apache-2.0
#include "passes/pixel_filter.h"

#include <cmath>
#include <numbers>

namespace bounce::passes {
namespace {

// Blackman-Harris, four terms (Harris 1978, "On the use of windows for harmonic analysis with the discrete
// Fourier transform").
constexpr double k_terms[4] = {0.35875, 0.48829, 0.14128, 0.01168};

// Share of the weight below t, the place within the window from 0 to 1: the window's integral.
double share_below(double t) {
    const double angle = 2.0 * std::numbers::pi * t;
    const double waves = -k_terms[1] * std::sin(angle) + k_terms[2] * std::sin(2.0 * angle) / 2.0 -
                         k_terms[3] * std::sin(3.0 * angle) / 3.0;
    return t + waves / (2.0 * std::numbers::pi * k_terms[0]);
}

}  // namespace

double pixel_filter(double distance_px) {
    const double t = 2.0 * std::numbers::pi * (distance_px / k_pixel_filter_width + 0.5);
    const bool inside = std::abs(distance_px) < 0.5 * k_pixel_filter_width;
    return inside ? k_terms[0] - k_terms[1] * std::cos(t) + k_terms[2] * std::cos(2.0 * t) -
                        k_terms[3] * std::cos(3.0 * t)
                  : 0.0;
}

double pixel_filter_quantile(double u) {
    // The upper half by symmetry, so that u and 1 - u lie equally far off to the bit.
    if (u > 0.5) {
        return -pixel_filter_quantile(1.0 - u);
    }
    if (u == 0.5) {
        return 0.0;
    }
    double low = 0.0;
    double high = 0.5;
    // Halving an interval below 1 so often leaves less than a double's last digit.
    for (int i = 0; i < 54; ++i) {
        const double middle = 0.5 * (low + high);
        (share_below(middle) < u ? low : high) = middle;
    }
    return (0.5 * (low + high) - 0.5) * k_pixel_filter_width;
}

}  // namespace bounce::passes
