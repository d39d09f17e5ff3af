// SPDX-License-Identifier: Apache-2.0
#include "image/convolution.h"

#include <algorithm>

namespace bounce {

Plane filter_rows(const Plane& plane, const Kernel& kernel) {
    Plane result(plane.width, plane.height);
    const int radius = static_cast<int>(kernel.size() / 2);
    const auto width = static_cast<size_t>(plane.width);
    // A row with its border repeated, so that the loop over it needs no test.
    std::vector<float> padded(width + 2U * static_cast<size_t>(radius));
    for (size_t y = 0; y < static_cast<size_t>(plane.height); ++y) {
        const float* row = &plane.values[y * width];
        std::fill_n(padded.begin(), radius, row[0]);
        std::copy_n(row, width, padded.begin() + radius);
        std::fill_n(padded.begin() + radius + plane.width, radius, row[width - 1]);
        float* out = &result.values[y * width];
        for (size_t i = 0; i < kernel.size(); ++i) {
            const float weight = kernel[i];
            const float* in = &padded[i];
            for (size_t x = 0; x < width; ++x) {
                out[x] += weight * in[x];
            }
        }
    }
    return result;
}

Plane filter_columns(const Plane& plane, const Kernel& kernel) {
    Plane result(plane.width, plane.height);
    const int radius = static_cast<int>(kernel.size() / 2);
    const auto width = static_cast<size_t>(plane.width);
    for (int y = 0; y < plane.height; ++y) {
        float* out = &result.values[static_cast<size_t>(y) * width];
        for (size_t i = 0; i < kernel.size(); ++i) {
            const float weight = kernel[i];
            const auto from =
                static_cast<size_t>(std::clamp(y + static_cast<int>(i) - radius, 0, plane.height - 1));
            const float* in = &plane.values[from * width];
            for (size_t x = 0; x < width; ++x) {
                out[x] += weight * in[x];
            }
        }
    }
    return result;
}

}  // namespace bounce
