// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace bounce {

// Scene-linear Rec. 709 floats, RGB interleaved, rows from top to bottom, width * height * 3 values.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<float> rgb;

    Image() = default;
    Image(int w, int h) : width(w), height(h), rgb(static_cast<size_t>(w) * static_cast<size_t>(h) * 3U) {}
    [[nodiscard]] size_t offset(int x, int y) const {
        return (static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)) * 3U;
    }
};

// Whether every value is 0.
[[nodiscard]] inline bool is_black(const Image& image) {
    return std::all_of(image.rgb.begin(), image.rgb.end(), [](float value) { return value == 0.0F; });
}

}  // namespace bounce
