// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace bounce {

// Where within and around their pixels `count` frames look, in pixels from the middle, so that the frames'
// plain mean is the picture filtered as by Cycles (Blackman-Harris, 1.5 px). One frame looks at the middle.
//
// A rank-1 lattice, warped by importance sampling the filter: of all lattices of so many points the one whose
// points are farthest apart (Dammertz and Keller 2008, "Image Synthesis by Rank-1 Lattices"). All points
// differ along both axes, evenly by the filter's weight, and lie in pairs across the middle, so no picture is
// displaced. Edges at random angles come out as with Owen-scrambled Sobol points or better at every count
// from 2 to 128, and half as wrong as with the R2 sequence (docs/parity.md).
[[nodiscard]] std::vector<glm::dvec2> pixel_offsets(int count);

}  // namespace bounce
