// SPDX-License-Identifier: Apache-2.0
//
// Pictures of where two images differ. All results are display-referred, 0..1.
#pragma once

#include "image/convolution.h"
#include "image/image.h"

namespace bounce {

// The magma map of matplotlib (Smith and van der Walt, 2015, CC0): 0 and less black, 1 and more pale
// yellow, lightness rising evenly between.
[[nodiscard]] Image magma(const Plane& values);

// sqrt of the mean over channels of (a - b)^2 / (b^2 + 0.01) in each pixel: the mean of its square over
// the plane is relMSE.
[[nodiscard]] Plane relative_error(const Image& test, const Image& reference);

// Four times the absolute difference of two display-referred images: a difference of 1/4 is full.
[[nodiscard]] Image magnified_difference(const Image& test_display, const Image& reference_display);

}  // namespace bounce
