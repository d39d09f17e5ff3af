// SPDX-License-Identifier: Apache-2.0
#include "core/progress.h"

#include <gtest/gtest.h>
#include <unistd.h>

namespace bounce {
namespace {

TEST(ProgressTest, OneLineAStepAwayFromATerminal) {
    testing::internal::CaptureStderr();
    {
        Progress progress("Rendering", 2);
        progress.step("frame 1");
        progress.step("frame 2");
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              "Rendering 1/2: frame 1; 0 s left\nRendering 2/2: frame 2\n");
}

TEST(ProgressTest, WhatWasThereAlreadySaysNothingOfTheTimeLeft) {
    testing::internal::CaptureStderr();
    {
        Progress progress("Rendering", 3);
        progress.found("a");
        progress.step("b");
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "Rendering 1/3: a\nRendering 2/3: b; 0 s left\n");
}

TEST(RoughTime, IsForPeople) {
    EXPECT_EQ(rough_time(0.2), "0 s");
    EXPECT_EQ(rough_time(89), "89 s");
    EXPECT_EQ(rough_time(200), "3 min");
    EXPECT_EQ(rough_time(4800), "1 h 20 min");
}

TEST(ProgressTest, NoStepsAndMoreThanAnnounced) {
    testing::internal::CaptureStderr();
    {
        const Progress idle("Idle", 0);
        Progress more("More", 1);
        more.step("a");
        more.step("b");
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "More 1/1: a\nMore 2/1: b\n");
}

}  // namespace
}  // namespace bounce
