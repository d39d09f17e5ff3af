// SPDX-License-Identifier: Apache-2.0
#include "viewer/playback.h"

#include <gtest/gtest.h>

namespace bounce::viewer {
namespace {

constexpr double k_start = 1000.0;  // any clock
constexpr scene::FrameRange k_range{.start = 5, .end = 14, .fps = 10.0};

TEST(Playback, BeginsPausedAtTheFirstFrame) {
    Playback playback(k_range);
    EXPECT_FALSE(playback.playing());
    EXPECT_EQ(playback.frame(), 5);
    EXPECT_DOUBLE_EQ(playback.time_s(), 0.0);
    EXPECT_FALSE(playback.advance(k_start + 100.0));
    EXPECT_EQ(playback.frame(), 5);
}

TEST(Playback, ShowsTheFrameThatIsDue) {
    Playback playback(k_range);
    playback.play(k_start);
    EXPECT_FALSE(playback.advance(k_start + 0.09));
    EXPECT_NEAR(playback.seconds_to_next(k_start + 0.09), 0.01, 1e-9);
    EXPECT_TRUE(playback.advance(k_start + 0.11));
    EXPECT_EQ(playback.frame(), 6);
    EXPECT_DOUBLE_EQ(playback.time_s(), 0.1);
}

TEST(Playback, RealtimeDropsFramesAndKeepsItsSchedule) {
    Playback playback(k_range);
    playback.play(k_start);
    EXPECT_TRUE(playback.advance(k_start + 0.35));
    EXPECT_EQ(playback.frame(), 8);
    // The half frame that was waited too long does not push the schedule.
    EXPECT_TRUE(playback.advance(k_start + 0.41));
    EXPECT_EQ(playback.frame(), 9);
}

TEST(Playback, RoundingDoesNotAddUpOverAnHour) {
    Playback playback({.start = 1, .end = 24, .fps = 23.976});
    playback.play(k_start);
    for (int i = 1; i <= 3600 * 50; ++i) {
        playback.advance(k_start + i / 50.0);
    }
    const auto due = static_cast<int>(3600.0 * 23.976 + 1e-3);
    EXPECT_EQ(playback.frame(), 1 + due % 24);
}

TEST(Playback, EveryFrameDropsNone) {
    Playback playback(k_range);
    playback.set_pace(Pace::every_frame, k_start);
    playback.play(k_start);
    EXPECT_TRUE(playback.advance(k_start + 0.35));
    EXPECT_EQ(playback.frame(), 6);
    EXPECT_FALSE(playback.advance(k_start + 0.40));
    EXPECT_TRUE(playback.advance(k_start + 0.46));
    EXPECT_EQ(playback.frame(), 7);
}

TEST(Playback, LoopsToTheFirstFrame) {
    Playback playback(k_range);
    playback.seek(14, k_start);
    playback.play(k_start);
    EXPECT_TRUE(playback.advance(k_start + 0.11));
    EXPECT_EQ(playback.frame(), 5);
    EXPECT_TRUE(playback.playing());
}

TEST(Playback, AWholeTurnOfTheLoopIsTheSameFrame) {
    Playback playback(k_range);
    playback.play(k_start);
    EXPECT_FALSE(playback.advance(k_start + 1.0));
    EXPECT_EQ(playback.frame(), 5);
    EXPECT_TRUE(playback.advance(k_start + 1.3));
    EXPECT_EQ(playback.frame(), 8);
}

TEST(Playback, WithoutLoopStopsAtTheEndAndStartsOver) {
    Playback playback(k_range);
    playback.set_loop(false);
    playback.play(k_start);
    EXPECT_TRUE(playback.advance(k_start + 5.0));
    EXPECT_EQ(playback.frame(), 14);
    EXPECT_FALSE(playback.playing());
    playback.play(k_start + 6.0);
    EXPECT_EQ(playback.frame(), 5);
    EXPECT_TRUE(playback.playing());
}

TEST(Playback, PausingKeepsTheFrame) {
    Playback playback(k_range);
    playback.play(k_start);
    playback.advance(k_start + 0.3);
    playback.toggle(k_start + 0.3);
    EXPECT_FALSE(playback.advance(k_start + 9.0));
    EXPECT_EQ(playback.frame(), 8);
    // Going on starts from there, not from where the clock has run to.
    playback.toggle(k_start + 9.0);
    EXPECT_FALSE(playback.advance(k_start + 9.05));
    EXPECT_TRUE(playback.advance(k_start + 9.15));
    EXPECT_EQ(playback.frame(), 9);
}

TEST(Playback, ScrubbingWhilePlayingGoesOnFromThere) {
    Playback playback(k_range);
    playback.play(k_start);
    playback.seek(10, k_start + 0.35);
    EXPECT_EQ(playback.frame(), 10);
    EXPECT_FALSE(playback.advance(k_start + 0.40));
    EXPECT_TRUE(playback.advance(k_start + 0.46));
    EXPECT_EQ(playback.frame(), 11);
}

TEST(Playback, SeekStopsAtTheEnds) {
    Playback playback(k_range);
    playback.seek(99, k_start);
    EXPECT_EQ(playback.frame(), 14);
    playback.seek(-99, k_start);
    EXPECT_EQ(playback.frame(), 5);
}

TEST(Playback, StepsAroundTheEndsAndPauses) {
    Playback playback(k_range);
    playback.play(k_start);
    playback.step(-1);
    EXPECT_EQ(playback.frame(), 14);
    EXPECT_FALSE(playback.playing());
    playback.step(1);
    EXPECT_EQ(playback.frame(), 5);
}

TEST(Playback, ASingleFrameDoesNotPlay) {
    Playback playback({.start = 7, .end = 7, .fps = 24.0});
    playback.play(k_start);
    EXPECT_FALSE(playback.playing());
    playback.step(1);
    EXPECT_EQ(playback.frame(), 7);
}

TEST(Playback, AShorterRangeKeepsTheFrameInside) {
    Playback playback(k_range);
    playback.seek(14, k_start);
    playback.set_range({.start = 1, .end = 10, .fps = 24.0});
    EXPECT_EQ(playback.frame(), 10);
    EXPECT_DOUBLE_EQ(playback.time_s(), 9.0 / 24.0);
}

}  // namespace
}  // namespace bounce::viewer
