// SPDX-License-Identifier: Apache-2.0
//
// How many samples a reference gets: a stated number, or as many as its noise must be small for.
#pragma once

#include <array>

#include "evaluate/reference.h"

namespace bounce {

// A reference grows in batches of two halves, each with a seed of its own, so that a run that is killed loses
// at most one half, and so that more samples can be added to a reference that was finished earlier.
inline constexpr int k_batch_spp = 2048;

struct ReferenceGoal {
    int spp = 0;  // exactly so many, even; 0: first_spp, then until the noise floor is small enough
    int first_spp = 1024;
    // Where spp is 0: samples are added until the noise floor is at most this part of the smallest error
    // measured against the reference, or until there are limit_spp.
    double floor_share = 0.1;
    int limit_spp = 16384;
};

// True where the noise floor is small enough for the errors measured against the reference.
[[nodiscard]] bool floor_is_low(const ReferenceGoal& goal, const Reference& reference, double smallest_error);

// Samples that the reference should have, at least those it has. smallest_error: relMSE, the least that was
// measured against it, its own noise included; ignored where the reference has no samples yet. Noise falls as
// one over the samples; as its own estimate is noisy and the smallest error falls with it, no step is more
// than fourfold and the next one starts from what was measured after it.
[[nodiscard]] int wanted_spp(const ReferenceGoal& goal, const Reference& reference, double smallest_error);

// Samples of the next batch towards `wanted`, even; 0 where there is none to add.
[[nodiscard]] int next_batch_spp(int have, int wanted);

// Seeds of a batch's halves, batches counted from 0. Seed 3 is never among them: k_seed_ladder.
[[nodiscard]] std::array<int, 2> batch_seeds(int batch);

// The seed of Cycles' points that are measured, so that they share no error with the reference.
inline constexpr int k_seed_ladder = 3;

}  // namespace bounce
