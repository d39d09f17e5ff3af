// SPDX-License-Identifier: Apache-2.0
#include "image/sequence_metrics.h"

#include <cmath>
#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "image/sequence_json.h"

namespace bounce {
namespace {

constexpr int k_frames = 10;

Image constant(float value, int width = 12, int height = 11) {
    Image image(width, height);
    std::fill(image.rgb.begin(), image.rgb.end(), value);
    return image;
}

// No motion, every surface 5 m away.
Image still(float dx = 0.0F) {
    Image image = constant(0.0F);
    for (size_t i = 0; i < image.rgb.size(); i += 3) {
        image.rgb[i] = dx;
        image.rgb[i + 2] = 5.0F;
    }
    return image;
}

float flickering(int frame) {
    return frame % 2 == 0 ? 0.55F : 0.45F;
}

TEST(EvenStep, IsTheDistanceOfFramesThatRunForwards) {
    EXPECT_EQ(even_step({1, 2, 3}), 1);
    EXPECT_EQ(even_step({1, 24}), 23);
    EXPECT_EQ(even_step({-3, -1, 1}), 2);
    for (const std::vector<int>& none : {std::vector<int>{}, {7}, {1, 2, 4}, {3, 2, 1}, {5, 5}}) {
        EXPECT_EQ(even_step(none), 0);
    }
}

TEST(SequenceMetrics, FlickerByHand) {
    SequenceMeter meter;
    const Image motion = still();
    const Image reference = constant(0.5F);
    for (int frame = 1; frame <= k_frames; ++frame) {
        meter.add(frame, constant(flickering(frame)), &reference, frame == 1 ? nullptr : &motion);
    }
    const SequenceMetrics metrics = meter.finish();
    // 0.5 +- 0.05: (0.05 / 0.5)^2, all of it fast; from frame to frame it is 0.1.
    EXPECT_NEAR(metrics.mean_luminance, 0.5, 1e-6);
    EXPECT_NEAR(metrics.flicker_power, 0.01, 1e-6);
    EXPECT_NEAR(metrics.flicker_share, 1.0, 1e-6);
    EXPECT_NEAR(metrics.tid, 0.1, 1e-6);
    EXPECT_NEAR(metrics.tid_relative, 0.2, 1e-6);
    EXPECT_EQ(metrics.tid_reference, 0.0);
    EXPECT_EQ(metrics.tid_coverage, 1.0);
    EXPECT_EQ(metrics.flicker_pixels, 1.0);
    // Every step is the same two pictures.
    EXPECT_GT(metrics.flip_step_mean, 0.01);
    EXPECT_NEAR(metrics.flip_step_mean, metrics.flip_step_max, 1e-6);
    EXPECT_EQ(metrics.flip_step_reference_mean, 0.0);
    // A frame alone has its bias; the mean over frames has none.
    ASSERT_TRUE(metrics.frames[1].error.has_value());
    EXPECT_NEAR(metrics.frames[1].error->bias, 0.1, 1e-5);
    EXPECT_NEAR(mean_over_frames(metrics, *find_metric("bias")), 0.0, 1e-6);
}

// Light that rises by 0.1 a frame and light that jumps by 0.1 to and fro have the same TID: only the spectrum
// tells them apart. Both are measured without a reference on pixels that stand still.
TEST(SequenceMetrics, TheSpectrumTellsFlickerFromChange) {
    const auto measure = [](float (*value)(int)) {
        SequenceMeter meter;
        const Image motion = still();
        for (int frame = 1; frame <= 16; ++frame) {
            meter.add(frame, constant(value(frame)), nullptr, frame == 1 ? nullptr : &motion);
        }
        return meter.finish();
    };
    const SequenceMetrics rising = measure([](int frame) { return 0.1F * static_cast<float>(frame); });
    const SequenceMetrics flicker = measure([](int frame) { return frame % 2 == 0 ? 0.9F : 0.8F; });
    EXPECT_NEAR(rising.mean_luminance, flicker.mean_luminance, 1e-6);  // 0.85
    EXPECT_NEAR(rising.tid, 0.1, 1e-6);
    EXPECT_NEAR(flicker.tid, 0.1, 1e-6);
    EXPECT_NEAR(flicker.flicker_power, 0.0025 / (0.85 * 0.85), 1e-6);
    EXPECT_NEAR(flicker.flicker_share, 1.0, 1e-6);
    // 0.023 % of the ramp's energy is fast (tests/unit/image/temporal_spectrum_test.cpp).
    EXPECT_LT(rising.flicker_share, 5e-4);
    EXPECT_LT(rising.flicker_power, 0.05 * flicker.flicker_power);
}

TEST(SequenceMetrics, ASteadySequenceHasNothing) {
    SequenceMeter meter;
    const Image motion = still();
    const Image reference = constant(0.5F);
    for (int frame = 1; frame <= k_frames; ++frame) {
        meter.add(frame, constant(0.7F), &reference, frame == 1 ? nullptr : &motion);
    }
    const SequenceMetrics metrics = meter.finish();
    for (const NamedSequenceMetric& metric : named_sequence_metrics()) {
        EXPECT_EQ(metric.value(metrics), 0.0) << metric.name;
    }
}

// What flickers moves, so without a reference it is not looked at; the rest stands still and is steady.
TEST(SequenceMetrics, WithoutAReferenceOnlyStillPixelsCount) {
    SequenceMeter with_motion;
    SequenceMeter without;
    for (int frame = 1; frame <= k_frames; ++frame) {
        Image test = constant(0.5F);
        Image motion = still();
        for (size_t i = 0; i < test.rgb.size() / 2; i += 3) {
            test.rgb[i] = test.rgb[i + 1] = test.rgb[i + 2] = flickering(frame);
            motion.rgb[i] = frame == 5 ? 1.0F : 0.0F;  // moving in one frame is enough
        }
        with_motion.add(frame, test, nullptr, frame == 1 ? nullptr : &motion);
        without.add(frame, test, nullptr, nullptr);
    }
    const SequenceMetrics masked = with_motion.finish();
    EXPECT_EQ(masked.flicker_power, 0.0);
    EXPECT_EQ(masked.flicker_pixels, 0.5);
    const SequenceMetrics all = without.finish();
    EXPECT_NEAR(all.flicker_power, 0.5 * 0.01, 1e-6);
    EXPECT_TRUE(std::isnan(all.tid)) << "nothing says where surfaces were";
    EXPECT_FALSE(all.frames[0].error.has_value());
    EXPECT_FALSE(sequence_to_json(all).contains("worst"));
}

TEST(SequenceMetrics, TheLargestStepHasItsFrame) {
    SequenceMeter meter;
    for (int frame = 1; frame <= 6; ++frame) {
        meter.add(frame, constant(frame >= 4 ? 0.6F : 0.5F), nullptr, nullptr);
    }
    const SequenceMetrics metrics = meter.finish();
    EXPECT_EQ(metrics.flip_step_max_frame, 4);
    EXPECT_NEAR(metrics.flip_step_mean, metrics.flip_step_max / 5.0, 1e-9);
    EXPECT_TRUE(std::isnan(metrics.flicker_power)) << "six frames are too few";
}

TEST(SequenceMetrics, OneValueThatIsNotFiniteLeavesNoFigure) {
    SequenceMeter meter;
    const Image reference = constant(0.5F);
    for (int frame = 1; frame <= k_frames; ++frame) {
        Image test = constant(0.5F);
        if (frame == 7) {
            test.rgb[40] = std::numeric_limits<float>::quiet_NaN();
        }
        meter.add(frame, test, &reference, nullptr);
    }
    const SequenceMetrics metrics = meter.finish();
    EXPECT_EQ(metrics.nan, 1U);
    for (const NamedSequenceMetric& metric : named_sequence_metrics()) {
        EXPECT_TRUE(std::isnan(metric.value(metrics))) << metric.name;
    }
    const SequenceFrame* worst = worst_frame(metrics, *find_metric("relmse"));
    ASSERT_NE(worst, nullptr);
    EXPECT_EQ(worst->frame, 7);
    EXPECT_TRUE(sequence_to_json(metrics)["sequence"]["flicker_power"].is_null());
}

TEST(SequenceMetrics, RefusesDifferentSizes) {
    SequenceMeter meter;
    meter.add(1, constant(0.5F), nullptr, nullptr);
    const Image wide = constant(0.5F, 13);
    const Image reference = constant(0.5F);
    for (const auto& add : std::initializer_list<std::function<void()>>{
             [&] { meter.add(2, wide, nullptr, nullptr); },
             [&] { meter.add(2, constant(0.5F), &wide, nullptr); },
             [&] { meter.add(2, constant(0.5F), nullptr, &wide); }}) {
        try {
            add();
            ADD_FAILURE() << "taken";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::input_refused);
            EXPECT_THAT(error.what(),
                        testing::HasSubstr("of frame 2 is 13x11 but the sequence began with 12x11"));
        }
    }
}

}  // namespace
}  // namespace bounce
