// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace bounce {

// One channel, rows from top to bottom, width * height values.
struct Plane {
    int width = 0;
    int height = 0;
    std::vector<float> values;

    Plane() = default;
    Plane(int w, int h) : width(w), height(h), values(static_cast<size_t>(w) * static_cast<size_t>(h)) {}
};

// Weights of offsets -radius .. +radius; an odd count.
using Kernel = std::vector<float>;

// Correlates every row (column) with the kernel: out(x) = sum of kernel[r + i] * in(x + i). Beyond the
// border the nearest pixel counts.
[[nodiscard]] Plane filter_rows(const Plane& plane, const Kernel& kernel);
[[nodiscard]] Plane filter_columns(const Plane& plane, const Kernel& kernel);

}  // namespace bounce
