// SPDX-License-Identifier: Apache-2.0
#include "evaluate/reference_growth.h"

#include <limits>
#include <set>

#include <gtest/gtest.h>

namespace bounce {
namespace {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

Reference with(int spp, double floor) {
    Reference reference;
    reference.spp = spp;
    reference.noise_floor = floor;
    return reference;
}

TEST(ReferenceGrowth, AStatedNumberIsKept) {
    const ReferenceGoal goal{.spp = 96};
    EXPECT_EQ(wanted_spp(goal, {}, k_nan), 96);
    EXPECT_EQ(wanted_spp(goal, with(96, 1.0), 1e-6), 96) << "however high its floor is";
}

TEST(ReferenceGrowth, UntilTheFloorIsATenth) {
    const ReferenceGoal goal;
    EXPECT_EQ(wanted_spp(goal, {}, k_nan), 1024);
    EXPECT_EQ(wanted_spp(goal, with(1024, 1e-4), 1e-3), 1024);
    // Own error 1.9e-3 - 1e-3 = 9e-4; sought floor 1e-4: ten times the samples, but four in one step.
    EXPECT_EQ(wanted_spp(goal, with(1024, 1e-3), 1.9e-3), 4096);
    // Own error 1.8e-3; sought 2e-4, twice the samples and 15 % in reserve, in steps of 128.
    EXPECT_EQ(wanted_spp(goal, with(1024, 4e-4), 2.2e-3), 2432);
    EXPECT_EQ(wanted_spp(goal, with(12800, 1e-3), 1.9e-3), 16384) << "the limit";
    EXPECT_EQ(wanted_spp(goal, with(16384, 1e-3), 1.9e-3), 16384);
    EXPECT_EQ(wanted_spp(goal, with(1024, 1e-3), 0.5e-3), 4096) << "an error below the floor is all noise";
}

TEST(ReferenceGrowth, NothingToMeasureAgainstAsksForNothing) {
    EXPECT_EQ(wanted_spp({}, with(1024, 1.0), std::numeric_limits<double>::infinity()), 1024);
    EXPECT_EQ(wanted_spp({}, with(1024, 1.0), k_nan), 1024);
}

TEST(ReferenceGrowth, BatchesAddUp) {
    int have = 0;
    int batches = 0;
    while (const int spp = next_batch_spp(have, 5000)) {
        EXPECT_EQ(spp % 2, 0);
        have += spp;
        ++batches;
    }
    EXPECT_EQ(have, 5000);
    EXPECT_EQ(batches, 3);
    EXPECT_EQ(next_batch_spp(100, 64), 0) << "a finished reference is never cut";
}

TEST(ReferenceGrowth, NoTwoRendersShareASeed) {
    std::set<int> seeds{k_seed_ladder};
    for (int batch = 0; batch < 100; ++batch) {
        for (const int seed : batch_seeds(batch)) {
            EXPECT_TRUE(seeds.insert(seed).second) << "seed " << seed << " of batch " << batch;
        }
    }
}

}  // namespace
}  // namespace bounce
