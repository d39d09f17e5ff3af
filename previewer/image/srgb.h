// SPDX-License-Identifier: Apache-2.0
//
// The sRGB transfer curve of IEC 61966-2-1, both ways, on one channel.
#pragma once

#include <cmath>

namespace bounce {

// Scene- or display-linear value to the non-linear sRGB value; linear near 0, so negative values stay finite.
[[nodiscard]] inline float srgb_from_linear(float linear) {
    return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
}

// The inverse of srgb_from_linear.
[[nodiscard]] inline float linear_from_srgb(float encoded) {
    return encoded <= 0.04045F ? encoded / 12.92F : std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}

}  // namespace bounce
