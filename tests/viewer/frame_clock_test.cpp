// SPDX-License-Identifier: Apache-2.0
#include "viewer/frame_clock.h"

#include <gtest/gtest.h>

namespace bounce::viewer {
namespace {

TEST(FrameClock, IsTheMedianOfTheLastThirty) {
    FrameClock clock;
    EXPECT_EQ(clock.median_ms(), 0.0);
    clock.add(8.0);
    EXPECT_EQ(clock.median_ms(), 8.0);
    clock.add(4.0);
    EXPECT_EQ(clock.median_ms(), 6.0);
    clock.add(1000.0);
    EXPECT_EQ(clock.median_ms(), 8.0);
    for (int i = 0; i < 30; ++i) {
        clock.add(i < 15 ? 2.0 : 3.0);
    }
    EXPECT_EQ(clock.median_ms(), 2.5);
    clock.clear();
    EXPECT_EQ(clock.median_ms(), 0.0);
}

}  // namespace
}  // namespace bounce::viewer
