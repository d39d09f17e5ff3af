// SPDX-License-Identifier: Apache-2.0
#include "gl/pass_timer.h"

#include <array>
#include <vector>

#include "gl/texture.h"
#include "gl_context.h"

namespace bounce::gl {
namespace {

class PassTimerTest : public test::GlTest {
  protected:
    // Work that no driver does in no time: clears 64 MiB.
    void time_two_passes(PassTimer& timer) {
        const std::array<float, 4> one = {1.0F, 1.0F, 1.0F, 1.0F};
        timer.begin("heavy");
        for (int i = 0; i < 4; ++i) {
            glClearTexImage(large_.id(), 0, GL_RGBA, GL_FLOAT, one.data());
        }
        timer.end();
        timer.begin("light");
        timer.end();
    }
    void SetUp() override {
        GlTest::SetUp();
        large_ = Texture("large", {.format = GL_RGBA32F, .width = 2048, .height = 2048});
    }
    Texture large_;
};

TEST_F(PassTimerTest, OffMeasuresNothing) {
    PassTimer timer(TimingMode::off);
    time_two_passes(timer);
    EXPECT_TRUE(timer.collect().empty());
}

TEST_F(PassTimerTest, FinishMeasuresWallTimeInOrder) {
    PassTimer timer(TimingMode::finish);
    time_two_passes(timer);
    const std::vector<PassTime> times = timer.collect();
    ASSERT_EQ(times.size(), 2U);
    EXPECT_EQ(times[0].name, "heavy");
    EXPECT_EQ(times[1].name, "light");
    EXPECT_GT(times[0].gpu_ms, times[1].gpu_ms);
    EXPECT_GT(times[0].gpu_ms, 0.1) << "256 MiB at 2.5 TB/s";
    EXPECT_GE(times[0].gpu_ms, times[0].cpu_ms) << "the finish comes after our calls";
    EXPECT_LT(times[0].gpu_ms, 60e3);
}

TEST_F(PassTimerTest, QueryKeepsNamesAndOrderWithoutWaiting) {
    // What a software driver's queries say is not checked: it is not the time the work took.
    PassTimer timer(TimingMode::query);
    time_two_passes(timer);
    const std::vector<PassTime> times = timer.collect();
    ASSERT_EQ(times.size(), 2U);
    EXPECT_EQ(times[0].name, "heavy");
    EXPECT_EQ(times[1].name, "light");
    for (const PassTime& time : times) {
        EXPECT_GE(time.gpu_ms, 0.0);
        EXPECT_GE(time.cpu_ms, 0.0);
    }
}

TEST_F(PassTimerTest, CollectingClearsTheTimer) {
    for (const TimingMode mode : {TimingMode::query, TimingMode::finish}) {
        PassTimer timer(mode);
        time_two_passes(timer);
        EXPECT_EQ(timer.collect().size(), 2U);
        EXPECT_TRUE(timer.collect().empty());
        timer.begin("again");
        timer.end();
        const std::vector<PassTime> times = timer.collect();
        ASSERT_EQ(times.size(), 1U);
        EXPECT_EQ(times[0].name, "again");
    }
}

}  // namespace
}  // namespace bounce::gl
