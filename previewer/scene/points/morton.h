// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/glm.hpp>

namespace bounce::scene {

// Interleaves the lowest ten bits of three numbers: what is near along the code is near in space (Morton
// 1966, "A Computer Oriented Geodetic Data Base and a New Technique in File Sequencing").
inline uint32_t morton(const glm::uvec3& v) {
    uint32_t code = 0;
    for (uint32_t bit = 0; bit < 10; ++bit) {
        for (int axis = 0; axis < 3; ++axis) {
            code |= ((v[axis] >> bit) & 1U) << (3 * bit + static_cast<uint32_t>(axis));
        }
    }
    return code;
}

// The code of a place in a box of 1021 cells a side. Borders of cells lie where no half, third or tenth of the
// box does: what stands there by design has the same code however its numbers are rounded. Nor do roundings
// across a flat box count.
inline uint32_t morton_in_box(const glm::dvec3& place, const glm::dvec3& low, const glm::dvec3& high) {
    const glm::dvec3 side = high - low;
    const double longest = std::max({side.x, side.y, side.z});
    if (!(longest > 0.0) || !std::isfinite(longest)) {
        return 0;
    }
    const glm::dvec3 cells = 1021.37 / glm::max(side, glm::dvec3(1e-4 * longest));
    return morton(glm::uvec3(glm::clamp((place - low) * cells + 0.618, 0.0, 1023.0)));
}

}  // namespace bounce::scene
