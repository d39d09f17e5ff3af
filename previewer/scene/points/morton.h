// SPDX-License-Identifier: Apache-2.0
#pragma once

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

}  // namespace bounce::scene
