// SPDX-License-Identifier: Apache-2.0
//
// Differences between a frame and the one before at the same points of surfaces.
#pragma once

#include <cstddef>
#include <vector>

#include "image/convolution.h"
#include "image/image.h"

namespace bounce {

// What the layer `motion` holds of one pixel (docs/metrics.md): where the point of surface at its middle was
// in the frame before, (dx, dy) pixels to the right and down from the pixel itself, and how far before the
// camera it then was, metres; 0 where that frame did not show it.
//
// Sums over the pixels of one frame whose point the frame before shows.
struct ReprojectedDifference {
    double squared = 0.0;  // sum of (now - before)^2
    size_t matched = 0;    // pixels that have a match
    ReprojectedDifference& operator+=(const ReprojectedDifference& other) {
        squared += other.squared;
        matched += other.matched;
        return *this;
    }
};

// now, before: one channel each, of motion's size (asserted); before is read between pixel centres by
// bilinear weights. A neighbour that counts for less than 1 % is left out, so that what stands still is
// compared with itself. A pixel whose motion is not finite, or whose neighbours lie outside, has no match.
//   Barak, Bittner and Havran, 2013, "Temporally Coherent Adaptive Sampling for Imperfect Shadow Maps",
//   section 6.2, which calls the root of the mean over a sequence the temporal image difference (TID).
[[nodiscard]] ReprojectedDifference reprojected_difference(const Plane& now, const Plane& before,
                                                           const Image& motion);

// Sets to 0 what moves in this frame: more than 1/100 of a pixel, or without a match.
void keep_still_pixels(const Image& motion, std::vector<char>& mask);

}  // namespace bounce
