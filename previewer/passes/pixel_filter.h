// SPDX-License-Identifier: Apache-2.0
//
// Cycles' pixel filter along one axis; a pixel's is the product of two.
#pragma once

namespace bounce::passes {

// Cycles doubles the width that its Blackman-Harris filter is given (film.cpp): 1.5 px is a window over three
// pixels.
inline constexpr double k_pixel_filter_width = 3.0;

// The filter's weight so many pixels off the pixel's middle, not normalised; 0 outside.
[[nodiscard]] double pixel_filter(double distance_px);

// How far off the middle, in pixels, the share u (0 to 1) of the filter's weight lies below: the inverse of
// its cumulative distribution. 0 for one half.
[[nodiscard]] double pixel_filter_quantile(double u);

}  // namespace bounce::passes
