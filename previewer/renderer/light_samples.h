// SPDX-License-Identifier: Apache-2.0
//
// Places on a light's surface that stand for the whole of it, for soft shadows. Arithmetic without OpenGL.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace bounce {

// Shapes of radius or half side 1 around the origin.
enum class SampleShape {
    square,  // z = 0
    disk,    // z = 0
    // Places inside a ball whose projection along any direction is even over the ball's disk: a light with a
    // radius is a disk that faces each receiver, and one set of places has to serve all of them.
    ball,
};

// `count` places of equal weight, every aligned run of 2^k of them spread evenly by itself; count is a power
// of two. From Owen-scrambled Sobol' points; the square to the disk by Shirley and Chiu 1997, "A Low
// Distortion Map Between Disk and Square".
[[nodiscard]] std::vector<glm::dvec3> light_samples(SampleShape shape, int count, uint32_t seed = 0);

// Where each sample looks at the receiver, so that together they average a shadow's outline over the pixel:
// pixels from its middle, distributed as Cycles' pixel filter and independent of the places.
[[nodiscard]] std::vector<glm::dvec2> receiver_offsets(int count);

}  // namespace bounce
