// SPDX-License-Identifier: Apache-2.0
#include "image/reprojection.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>

namespace bounce {
namespace {

// Below this a neighbour's weight is rounding of a motion that ends on a pixel's centre.
constexpr double k_least_weight = 0.01;
constexpr double k_still_px = 0.01;

std::optional<double> sample(const Plane& plane, double x, double y) {
    const double left = std::floor(x);
    const double top = std::floor(y);
    // Before the conversion to whole numbers, which any float may be too large for.
    if (!(left >= -1.0 && top >= -1.0 && left < plane.width && top < plane.height)) {
        return std::nullopt;
    }
    const std::array<double, 2> across{1.0 - (x - left), x - left};
    const std::array<double, 2> down{1.0 - (y - top), y - top};
    double sum = 0.0;
    double weights = 0.0;
    for (size_t j = 0; j < 2; ++j) {
        for (size_t i = 0; i < 2; ++i) {
            const double weight = across[i] * down[j];
            if (weight < k_least_weight) {
                continue;
            }
            const int column = static_cast<int>(left) + static_cast<int>(i);
            const int row = static_cast<int>(top) + static_cast<int>(j);
            if (column < 0 || row < 0 || column >= plane.width || row >= plane.height) {
                return std::nullopt;
            }
            const size_t at =
                static_cast<size_t>(row) * static_cast<size_t>(plane.width) + static_cast<size_t>(column);
            sum += weight * static_cast<double>(plane.values[at]);
            weights += weight;
        }
    }
    return sum / weights;
}

}  // namespace

ReprojectedDifference reprojected_difference(const Plane& now, const Plane& before, const Image& motion) {
    assert(now.width == motion.width && now.height == motion.height);
    assert(before.width == motion.width && before.height == motion.height);
    ReprojectedDifference out;
    for (int y = 0; y < motion.height; ++y) {
        for (int x = 0; x < motion.width; ++x) {
            const size_t offset = motion.offset(x, y);
            const float* value = &motion.rgb[offset];
            if (!(value[2] > 0.0F)) {
                continue;
            }
            if (const auto there =
                    sample(before, x + static_cast<double>(value[0]), y + static_cast<double>(value[1]))) {
                const double difference = static_cast<double>(now.values[offset / 3]) - *there;
                out.squared += difference * difference;
                ++out.matched;
            }
        }
    }
    return out;
}

void keep_still_pixels(const Image& motion, std::vector<char>& mask) {
    for (size_t i = 0; i < mask.size(); ++i) {
        const float* value = &motion.rgb[3 * i];
        const bool still = value[2] > 0.0F && std::hypot(static_cast<double>(value[0]),
                                                         static_cast<double>(value[1])) <= k_still_px;
        mask[i] = static_cast<char>(mask[i] != 0 && still);
    }
}

}  // namespace bounce
