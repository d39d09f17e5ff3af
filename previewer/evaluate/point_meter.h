// SPDX-License-Identifier: Apache-2.0
//
// The errors of one point of a curve, frame by frame, by the same functions as `bounce compare`.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "evaluate/curves.h"
#include "evaluate/motion_layers.h"
#include "image/image.h"

namespace bounce {

// A frame that was drawn: its picture lies in a file, or in memory where that is where it was kept.
struct RenderedFrame {
    int frame = 1;
    double seconds = 0.0;
    std::filesystem::path file;
    const Image* held = nullptr;
    std::vector<double> all_seconds;  // of repeated renders, of which seconds is the median; may be empty

    [[nodiscard]] Image image() const;
};

// A point's frames, and its place among the curves.
struct RenderedPoint {
    size_t curve = 0;
    size_t point = 0;
    std::vector<RenderedFrame> frames;
};

using ReferenceImage = std::function<const Image&(int frame)>;

// The point of those frames. Pictures are read one after the other and not kept. Frames that are a sequence
// (even_step()) also have its figures, with TID where there are layers. Values that are not finite are a
// warning. HDR-FLIP is left out: hdr_flip_of_points.h. Throws input_error where a picture cannot be read.
[[nodiscard]] CurvePoint measure_point(std::string label, const std::vector<RenderedFrame>& frames,
                                       const ReferenceImage& reference, const MotionLayers& motion);

// The same pictures against others than the point's references.
[[nodiscard]] FinalErrors errors_against(const std::vector<RenderedFrame>& frames,
                                         const ReferenceImage& target);

}  // namespace bounce
