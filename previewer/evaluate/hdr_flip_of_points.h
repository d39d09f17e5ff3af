// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "evaluate/evaluation.h"
#include "evaluate/point_meter.h"

namespace bounce {

// What HDR-FLIP may take for all points together: pixels times exposures, of each picture and each reference.
// 60 pictures of 640 x 360 at 12 exposures are 169 millions and take 80 s of processor time.
constexpr size_t k_most_hdr_flip = 400'000'000;

// Fills in HDR-FLIP of the points' frames, and of the points as its mean: of all points where that is at most
// so much, else of those whose pictures the report shows (shown_points()). The others' stay NaN, as do those
// of frames with values that are not finite. A reference is looked at once for all pictures of its frame.
// Needs all curves and references of the evaluation.
void fill_hdr_flip(Evaluation& evaluation, const std::vector<RenderedPoint>& points,
                   size_t most = k_most_hdr_flip);

}  // namespace bounce
