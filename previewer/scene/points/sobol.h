// SPDX-License-Identifier: Apache-2.0
//
// Owen-scrambled Sobol points: every block of 2^k consecutive points is spread evenly over the unit cube, so
// a block serves as a sample of its own.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace bounce::scene {

// The point of this index in [0, 1)^3. Another seed gives an independent randomisation with the same
// stratification. Sobol 1967; direction numbers of the first three dimensions by Joe and Kuo 2008,
// "Constructing Sobol Sequences with Better Two-Dimensional Projections"; scrambling by Burley 2020,
// "Practical Hash-based Owen Scrambling", with the hash that Vegdahl 2021 found to scramble better.
[[nodiscard]] glm::dvec3 sobol_point(uint32_t index, uint32_t seed);

// A seed of the sequence for each number, far from one another; `seed` itself for 0.
[[nodiscard]] uint32_t numbered_seed(uint32_t seed, uint32_t number);

}  // namespace bounce::scene
