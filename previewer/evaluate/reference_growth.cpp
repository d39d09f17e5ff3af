// SPDX-License-Identifier: Apache-2.0
#include "evaluate/reference_growth.h"

#include <algorithm>
#include <cmath>

namespace bounce {
namespace {

constexpr double k_largest_step = 4.0;
constexpr double k_smallest_step = 1.25;
constexpr double k_reserve = 1.15;  // of the estimate, because both its terms are noisy
constexpr int k_granularity = 128;  // samples

}  // namespace

bool floor_is_low(const ReferenceGoal& goal, const Reference& reference, double smallest_error) {
    return reference.noise_floor <= goal.floor_share * smallest_error;
}

int wanted_spp(const ReferenceGoal& goal, const Reference& reference, double smallest_error) {
    if (goal.spp > 0) {
        return std::max(goal.spp, reference.spp);
    }
    if (reference.spp == 0) {
        return std::min(goal.first_spp, goal.limit_spp);
    }
    if (!std::isfinite(smallest_error) || floor_is_low(goal, reference, smallest_error) ||
        reference.spp >= goal.limit_spp) {
        return reference.spp;
    }
    // The measured error is the picture's own plus the floor f. Sought is f' = share * (own + f').
    const double own = std::max(smallest_error - reference.noise_floor, 0.0);
    const double floor = goal.floor_share * own / (1.0 - goal.floor_share);
    const double factor = floor > 0.0 ? k_reserve * reference.noise_floor / floor : k_largest_step;
    const double spp = reference.spp * std::clamp(factor, k_smallest_step, k_largest_step);
    const int rounded = static_cast<int>(std::ceil(spp / k_granularity)) * k_granularity;
    return std::max(std::min(rounded, goal.limit_spp), reference.spp);
}

int next_batch_spp(int have, int wanted) {
    return std::clamp((wanted - have) / 2 * 2, 0, k_batch_spp);
}

std::array<int, 2> batch_seeds(int batch) {
    const int first = batch == 0 ? 1 : 2 * batch + 2;
    return {first, first + 1};
}

}  // namespace bounce
