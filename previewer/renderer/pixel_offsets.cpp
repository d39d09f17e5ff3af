// SPDX-License-Identifier: Apache-2.0
#include "renderer/pixel_offsets.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>

#include "passes/pixel_filter.h"

namespace bounce {
namespace {

// The square of the least distance between two points i/count (1, step) on a torus, in units of 1/count.
int64_t least_distance(int64_t count, int64_t step) {
    int64_t least = std::numeric_limits<int64_t>::max();
    for (int64_t i = 1; i < count && i * i < least; ++i) {
        const int64_t y = i * step % count;
        const int64_t x_near = std::min(i, count - i);
        const int64_t y_near = std::min(y, count - y);
        least = std::min(least, x_near * x_near + y_near * y_near);
    }
    return least;
}

// The lattice's second generator; its first is 1.
int64_t best_step(int64_t count) {
    int64_t best = 1;
    int64_t farthest = 0;
    for (int64_t step = 1; step < count; ++step) {
        // A common divisor would put points at the same height.
        if (std::gcd(step, count) != 1) {
            continue;
        }
        if (const int64_t distance = least_distance(count, step); distance > farthest) {
            farthest = distance;
            best = step;
        }
    }
    return best;
}

}  // namespace

std::vector<glm::dvec2> pixel_offsets(int count) {
    const int64_t step = best_step(count);
    std::vector<glm::dvec2> offsets;
    for (int64_t i = 0; i < count; ++i) {
        const double u = (static_cast<double>(i) + 0.5) / count;
        const double v = (static_cast<double>(i * step % count) + 0.5) / count;
        offsets.emplace_back(passes::pixel_filter_quantile(u), passes::pixel_filter_quantile(v));
    }
    return offsets;
}

}  // namespace bounce
