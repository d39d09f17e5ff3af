// SPDX-License-Identifier: Apache-2.0
#include "evaluate/point_meter.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "fake_programs.h"
#include "image/metrics.h"
#include "temporary_folder.h"

namespace bounce {
namespace {

using test::TemporaryFolder;

constexpr int k_width = 12;
constexpr int k_height = 11;

Image constant(float value) {
    Image image(k_width, k_height);
    std::fill(image.rgb.begin(), image.rgb.end(), value);
    return image;
}

class PointMeterTest : public testing::Test {
  protected:
    PointMeterTest() : reference_(constant(0.5F)), program_(test::fake_bounce(folder_.path())) {
        Image still = constant(0.0F);
        for (size_t i = 2; i < still.rgb.size(); i += 3) still.rgb[i] = 5.0F;  // metres away, not moving
        write_image(folder_ / "motion.exr", still);
    }

    [[nodiscard]] MotionLayers motion(const std::vector<int>& frames) const {
        return {program_, folder_ / "scene.glb", frames, k_width, k_height, folder_ / "layers"};
    }

    // Pictures in memory of those values, a frame each from the first on.
    [[nodiscard]] CurvePoint measured(const std::vector<int>& frames,
                                      const std::vector<float>& values) const {
        std::vector<Image> pictures;
        std::transform(values.begin(), values.end(), std::back_inserter(pictures), constant);
        std::vector<RenderedFrame> rendered;
        for (size_t i = 0; i < frames.size(); ++i) rendered.push_back({frames[i], 0.5, {}, &pictures[i], {}});
        return measure_point(
            "x", rendered, [this](int) -> const Image& { return reference_; }, motion(frames));
    }

    [[nodiscard]] long motion_calls() const {
        std::ifstream in(folder_ / "motion_calls");
        return std::count(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>(), '\n');
    }

    TemporaryFolder folder_;
    Image reference_;
    std::filesystem::path program_;
};

// 0.5 +- 0.05: (0.05 / 0.5)^2, all of it fast; from frame to frame it is 0.1.
TEST_F(PointMeterTest, FlickerByHand) {
    const CurvePoint point =
        measured({1, 2, 3, 4, 5, 6, 7, 8}, {.55F, .45F, .55F, .45F, .55F, .45F, .55F, .45F});
    ASSERT_TRUE(point.sequence);
    EXPECT_NEAR(point.sequence->flicker_power, 0.01, 1e-6);
    EXPECT_NEAR(point.sequence->flicker_share, 1.0, 1e-6);
    EXPECT_NEAR(point.sequence->tid, 0.1, 1e-6);
    EXPECT_NEAR(point.sequence->tid_relative, 0.2, 1e-6);
    EXPECT_EQ(point.sequence->tid_reference, 0.0);
    EXPECT_EQ(point.sequence->tid_coverage, 1.0);
    EXPECT_EQ(point.sequence->flip_step_reference_max, 0.0);
    EXPECT_EQ(motion_calls(), 1) << "all frames in one process";
    // The errors of a sequence's frames are those of a frame alone.
    const Metrics alone = compare(constant(0.45F), reference_, HdrFlip::leave_out);
    EXPECT_EQ(point.frames[1].relmse, alone.relmse);
    EXPECT_EQ(point.frames[1].flip_ldr, alone.flip_ldr);
    EXPECT_EQ(point.frames[1].ssim, alone.ssim);
    EXPECT_EQ(point.frames[1].psnr_db, alone.psnr_db);
    EXPECT_EQ(point.frames[1].frame, 2);
    EXPECT_EQ(point.frames[1].seconds, 0.5);
}

TEST_F(PointMeterTest, AStepOfTwoHasNoTid) {
    const CurvePoint point = measured({1, 3, 5}, {.55F, .45F, .55F});
    ASSERT_TRUE(point.sequence);
    EXPECT_GT(point.sequence->flip_step_mean, 0.01);
    EXPECT_TRUE(std::isnan(point.sequence->tid));
    EXPECT_TRUE(std::isnan(point.sequence->flicker_power)) << "fewer than eight frames";
    EXPECT_EQ(motion_calls(), 0) << "the layer tells the way from the frame just before";
}

TEST_F(PointMeterTest, WhatIsNoSequenceHasNone) {
    EXPECT_FALSE(measured({7}, {.55F}).sequence);
    const CurvePoint uneven = measured({1, 2, 4}, {.55F, .45F, .55F});
    EXPECT_FALSE(uneven.sequence);
    EXPECT_EQ(uneven.frames[1].relmse, compare(constant(0.45F), reference_, HdrFlip::leave_out).relmse);
    EXPECT_EQ(motion_calls(), 0);
}

TEST_F(PointMeterTest, WithoutTheLayerEverythingElseIsTold) {
    std::filesystem::remove(folder_ / "motion.exr");
    const std::vector<int> frames{1, 2};
    testing::internal::CaptureStderr();
    EXPECT_FALSE(motion(frames).known());
    EXPECT_NE(testing::internal::GetCapturedStderr().find("TID is not told"), std::string::npos);
    const CurvePoint point = measured(frames, {.55F, .45F});
    ASSERT_TRUE(point.sequence);
    EXPECT_TRUE(std::isnan(point.sequence->tid));
    EXPECT_GT(point.sequence->flip_step_mean, 0.01);
}

TEST_F(PointMeterTest, APictureInAFile) {
    write_image(folder_ / "picture.exr", constant(0.25F));  // a half float
    const CurvePoint point = measure_point(
        "x", {{1, 0.5, folder_ / "picture.exr", nullptr, {0.75, 0.25, 0.5}}},
        [this](int) -> const Image& { return reference_; }, motion({1}));
    EXPECT_NEAR(point.relmse, 0.25 * 0.25 / 0.26, 1e-12);
    EXPECT_NEAR(point.bias, -0.5, 1e-9);
    EXPECT_EQ(point.seconds_least, 0.25);
    EXPECT_EQ(point.seconds_most, 0.75);
}

}  // namespace
}  // namespace bounce
