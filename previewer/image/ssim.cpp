// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "image/convolution.h"
#include "image/metrics.h"

namespace bounce {
namespace {

constexpr int k_window = 11;
constexpr double k_window_deviation_px = 1.5;
constexpr double k_c1 = 0.01 * 0.01;  // (K1 * range)^2
constexpr double k_c2 = 0.03 * 0.03;

// Gaussian of the given odd or even length around its middle, summing to 1.
std::vector<double> window(int length) {
    std::vector<double> kernel;
    double sum = 0.0;
    for (int i = 0; i < length; ++i) {
        const double x = i - (length - 1) / 2.0;
        kernel.push_back(std::exp(-x * x / (2.0 * k_window_deviation_px * k_window_deviation_px)));
        sum += kernel.back();
    }
    for (double& weight : kernel) {
        weight /= sum;
    }
    return kernel;
}

// Weighted sums over every window that lies inside the plane, in double: the variances below are
// differences of nearly equal sums.
std::vector<double> window_means(const Plane& a, const Plane& b, const std::vector<double>& across,
                                 const std::vector<double>& down) {
    const auto width = static_cast<size_t>(a.width);
    const size_t columns = width - across.size() + 1;
    const size_t rows = static_cast<size_t>(a.height) - down.size() + 1;
    std::vector<double> filtered(columns * static_cast<size_t>(a.height), 0.0);
    for (size_t y = 0; y < static_cast<size_t>(a.height); ++y) {
        for (size_t x = 0; x < columns; ++x) {
            for (size_t i = 0; i < across.size(); ++i) {
                const size_t at = y * width + x + i;
                filtered[y * columns + x] += across[i] * a.values[at] * b.values[at];
            }
        }
    }
    std::vector<double> means(columns * rows, 0.0);
    for (size_t y = 0; y < rows; ++y) {
        for (size_t i = 0; i < down.size(); ++i) {
            for (size_t x = 0; x < columns; ++x) {
                means[y * columns + x] += down[i] * filtered[(y + i) * columns + x];
            }
        }
    }
    return means;
}

}  // namespace

double ssim(const Plane& test, const Plane& reference) {
    assert(test.width == reference.width && test.height == reference.height);
    const std::vector<double> across = window(std::min(k_window, test.width));
    const std::vector<double> down = window(std::min(k_window, test.height));
    Plane one(test.width, test.height);
    std::fill(one.values.begin(), one.values.end(), 1.0F);

    const auto mean_a = window_means(test, one, across, down);
    const auto mean_b = window_means(reference, one, across, down);
    const auto mean_aa = window_means(test, test, across, down);
    const auto mean_bb = window_means(reference, reference, across, down);
    const auto mean_ab = window_means(test, reference, across, down);

    double sum = 0.0;
    for (size_t i = 0; i < mean_a.size(); ++i) {
        const double a = mean_a[i];
        const double b = mean_b[i];
        const double variance_a = mean_aa[i] - a * a;
        const double variance_b = mean_bb[i] - b * b;
        const double covariance = mean_ab[i] - a * b;
        sum += (2.0 * a * b + k_c1) * (2.0 * covariance + k_c2) /
               ((a * a + b * b + k_c1) * (variance_a + variance_b + k_c2));
    }
    return sum / static_cast<double>(mean_a.size());
}

}  // namespace bounce
