// SPDX-License-Identifier: Apache-2.0
#include "bench/samples.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace bounce::bench {
namespace {

TEST(Samples, BestAndMedian) {
    EXPECT_EQ((Samples{{5.0, 2.0, 9.0}}).best(), 2.0);
    EXPECT_EQ((Samples{{5.0, 2.0, 9.0}}).median(), 5.0);
    EXPECT_EQ((Samples{{4.0, 1.0, 2.0, 9.0}}).median(), 3.0);
    EXPECT_TRUE(std::isnan(Samples{}.best())) << "nothing measured is no time of 0";
    EXPECT_TRUE(std::isnan(Samples{}.median()));
}

// The best of a sum is of one frame, not the sum of bests of different ones.
TEST(Samples, AddFrameByFrame) {
    Samples sum;
    sum.add({{1.0, 10.0}});
    sum.add({{10.0, 2.0}});
    EXPECT_THAT(sum.ms, testing::ElementsAre(11.0, 12.0));
    EXPECT_EQ(sum.best(), 11.0);
}

TEST(Samples, RateInMillionsASecond) {
    EXPECT_DOUBLE_EQ(millions_a_second(5e6, 100.0), 50.0);
    EXPECT_DOUBLE_EQ(millions_a_second(230400.0 * 16.0, 36.864), 100.0);
    EXPECT_TRUE(std::isnan(millions_a_second(1.0, 0.0)));
    EXPECT_TRUE(std::isnan(millions_a_second(1.0, Samples{}.best())));
}

}  // namespace
}  // namespace bounce::bench
