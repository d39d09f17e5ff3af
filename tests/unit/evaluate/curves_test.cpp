// SPDX-License-Identifier: Apache-2.0
#include "evaluate/curves.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace bounce {
namespace {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

CurvePoint point(std::string label, double seconds, double relmse) {
    return make_point(std::move(label), {{1, seconds, relmse, relmse, 0.1, 0.9, 30.0, 0.0, 0}});
}

TEST(MakePoint, IsTheMeanOverFrames) {
    const CurvePoint mean = make_point(
        "x", {{1, 0.1, 0.02, 0.0, 0.2, 0.9, 30, 0.01, 0}, {24, 0.3, 0.04, 0.0, 0.4, 0.9, 30, -0.03, 0}});
    EXPECT_NEAR(mean.seconds, 0.2, 1e-12);
    EXPECT_NEAR(mean.relmse, 0.03, 1e-12);
    EXPECT_NEAR(mean.flip_ldr, 0.3, 1e-12);
    EXPECT_NEAR(mean.bias, -0.01, 1e-12);
    EXPECT_EQ(mean.frames.size(), 2U);
    EXPECT_TRUE(std::isnan(mean.flip_hdr)) << "no frame has it";
    EXPECT_FALSE(mean.sequence);
}

TEST(MakePoint, MeansOfEveryFigure) {
    FrameError first{1, 0.1, 0.02, 0.3, 0.2, 0.9, 30, 0.01, 0};
    FrameError second{2, 0.1, 0.02, 0.5, 0.2, 0.7, 40, 0.01, 0};
    first.nrmse = 0.25;
    second.nrmse = 0.75;
    second.smape = 0.5;
    first.bias_rgb = {0.1, 0.2, -0.4};
    second.bias_rgb = {0.3, 0.2, 0.2};
    first.flip_hdr = 0.25;
    second.flip_hdr = 0.75;
    const CurvePoint mean = make_point("x", {first, second});
    EXPECT_NEAR(mean.relmse_exposed, 0.4, 1e-12);
    EXPECT_NEAR(mean.ssim, 0.8, 1e-12);
    EXPECT_NEAR(mean.psnr_db, 35.0, 1e-12) << "of the decibels";
    EXPECT_NEAR(mean.flip_hdr, 0.5, 1e-12);
    EXPECT_NEAR(mean.nrmse, 0.5, 1e-12);
    EXPECT_NEAR(mean.smape, 0.25, 1e-12);
    EXPECT_NEAR(mean.bias_rgb[0], 0.2, 1e-12);
    EXPECT_NEAR(mean.bias_rgb[1], 0.2, 1e-12);
    EXPECT_NEAR(mean.bias_rgb[2], -0.1, 1e-12);
    second.flip_hdr = k_nan;
    EXPECT_TRUE(std::isnan(make_point("x", {first, second}).flip_hdr)) << "not of a part of the frames";
}

TEST(ParetoFront, KeepsWhatNothingBeats) {
    //                       fast, coarse  beaten     middle      slow, exact  beaten by a tie in time
    EXPECT_EQ(pareto_front({{1.0, 1.0}, {2.0, 1.5}, {2.0, 0.5}, {4.0, 0.1}, {4.0, 0.2}}),
              (std::vector<bool>{true, false, true, true, false}));
}

TEST(ParetoFront, EqualPointsAreBothOnIt) {
    EXPECT_EQ(pareto_front({{1.0, 1.0}, {1.0, 1.0}}), (std::vector<bool>{true, true}));
}

TEST(ParetoFront, NotANumberIsNeverOnIt) {
    EXPECT_EQ(pareto_front({{1.0, k_nan}, {k_nan, 0.1}, {2.0, 0.5}}),
              (std::vector<bool>{false, false, true}));
    EXPECT_TRUE(pareto_front({}).empty());
}

TEST(MarkPareto, LooksAtAllCurvesTogether) {
    std::vector<Curve> curves{{"Cycles", true, {point("1", 0.2, 0.3), point("64", 8.0, 0.002)}},
                              {"Bounce", false, {point("a", 0.1, 0.001)}}};
    mark_pareto(curves);
    EXPECT_FALSE(curves[0].points[0].pareto);
    EXPECT_FALSE(curves[0].points[1].pareto);
    EXPECT_TRUE(curves[1].points[0].pareto);
}

// Error falls with 1/time on this ladder: 0.1 at 1 s, 0.01 at 10 s, 0.001 at 100 s.
const std::vector<std::pair<double, double>> k_ladder{{100.0, 0.001}, {1.0, 0.1}, {10.0, 0.01}};

TEST(TimeAtError, InterpolatesBetweenLogarithms) {
    const auto at_point = time_at_error(k_ladder, 0.01);
    ASSERT_TRUE(at_point);
    EXPECT_NEAR(at_point->seconds, 10.0, 1e-9);
    EXPECT_EQ(at_point->kind, EqualErrorKind::interpolated);
    const auto between = time_at_error(k_ladder, std::sqrt(0.01 * 0.001));
    ASSERT_TRUE(between);
    EXPECT_NEAR(between->seconds, std::sqrt(10.0 * 100.0), 1e-9);
}

TEST(TimeAtError, ExtrapolatesAlongTheLastSegment) {
    const auto beyond = time_at_error(k_ladder, 0.0001);
    ASSERT_TRUE(beyond);
    EXPECT_NEAR(beyond->seconds, 1000.0, 1e-6);
    EXPECT_EQ(beyond->kind, EqualErrorKind::extrapolated);
}

// A firefly in the second point: the others say what they would without it.
TEST(TimeAtError, PointsThatAFasterOneBeatsDoNotCount) {
    const auto plain = time_at_error({{1.0, 0.1}, {10.0, 0.01}}, 0.05);
    const auto noisy = time_at_error({{1.0, 0.1}, {4.0, 2.4}, {10.0, 0.01}}, 0.05);
    ASSERT_TRUE(plain && noisy);
    EXPECT_EQ(noisy->seconds, plain->seconds);
    EXPECT_TRUE(time_at_error({{1.0, 0.1}, {4.0, 0.02}, {10.0, 2.4}}, 0.01)) << "the last one is";
}

TEST(TimeAtError, NothingIsExtrapolatedFlatterThanNoiseFalls) {
    // Ten times the time for half the error; then as one over the time: 0.05 at 10 s is 0.005 at 100 s.
    const auto flat = time_at_error({{1.0, 0.1}, {10.0, 0.05}}, 0.005);
    ASSERT_TRUE(flat);
    EXPECT_NEAR(flat->seconds, 100.0, 1e-6);
    // Steeper is followed: a hundredth of the error in ten times the time.
    const auto steep = time_at_error({{1.0, 0.1}, {10.0, 0.001}}, 0.00001);
    ASSERT_TRUE(steep);
    EXPECT_NEAR(steep->seconds, 100.0, 1e-6);
}

TEST(TimeAtError, TheFastestPointBoundsFromBelow) {
    const auto coarse = time_at_error(k_ladder, 0.5);
    ASSERT_TRUE(coarse);
    EXPECT_EQ(coarse->seconds, 1.0);
    EXPECT_EQ(coarse->kind, EqualErrorKind::fastest_point);
}

TEST(TimeAtError, SaysNothingWithoutALadder) {
    EXPECT_FALSE(time_at_error({}, 0.1));
    EXPECT_FALSE(time_at_error({{1.0, 0.1}}, 0.01));
    EXPECT_FALSE(time_at_error({{1.0, 0.1}, {2.0, k_nan}}, 0.01));
    EXPECT_FALSE(time_at_error(k_ladder, 0.0));
    EXPECT_FALSE(time_at_error(k_ladder, k_nan));
    EXPECT_FALSE(time_at_error({{1.0, 0.1}, {2.0, 0.1}}, 0.01))
        << "a ladder that does not improve reaches nothing";
}

TEST(Speedups, CompareEveryPointOfTheOthers) {
    const std::vector<Curve> curves{{"Cycles", true, {point("1", 1.0, 0.1), point("16", 10.0, 0.01)}},
                                    {"Bounce", false, {point("a", 0.5, 0.01), point("b", 1.0, 0.001)}}};
    const auto speedups = speedups_at_equal_error(curves);
    ASSERT_EQ(speedups.size(), 2U);
    EXPECT_EQ(speedups[0].curve, "Bounce");
    EXPECT_EQ(speedups[0].label, "a");
    EXPECT_NEAR(speedups[0].ratio, 20.0, 1e-9);
    EXPECT_NEAR(speedups[1].cycles_seconds, 100.0, 1e-6);
    EXPECT_EQ(speedups[1].kind, EqualErrorKind::extrapolated);
}

CurvePoint own_point(std::string label, double seconds, double relmse) {
    CurvePoint made = point(std::move(label), seconds, relmse);
    made.options = {"--vpls", "64"};
    return made;
}

TEST(MakePoint, SpreadIsTheMeanOverFramesAndNaNWhereUnknown) {
    FrameError frame{1, 0.1, 0.02, 0.02, 0.1, 0.9, 30, 0.0, 0};
    EXPECT_TRUE(std::isnan(make_point("x", {frame}).seconds_least));
    FrameError other = frame;
    frame.seconds_least = 0.09;
    frame.seconds_most = 0.12;
    EXPECT_TRUE(std::isnan(make_point("x", {frame, other}).seconds_most));
    other.seconds_least = 0.05;
    other.seconds_most = 0.16;
    EXPECT_NEAR(make_point("x", {frame, other}).seconds_least, 0.07, 1e-12);
    EXPECT_NEAR(make_point("x", {frame, other}).seconds_most, 0.14, 1e-12);
}

TEST(MarkPareto, BouncesOwnFrontLeavesOtherEnginesOut) {
    std::vector<Curve> curves{{"Cycles", true, {point("1", 0.01, 0.001)}},
                              {"Other", false, {point("peer", 0.02, 0.0005)}},
                              {"Bounce", false, {own_point("a", 0.1, 0.1), own_point("b", 0.2, 0.2)}}};
    mark_pareto(curves);
    EXPECT_FALSE(curves[2].points[0].pareto) << "Cycles is faster and more exact";
    EXPECT_TRUE(curves[2].points[0].own_front);
    EXPECT_FALSE(curves[2].points[1].own_front);
    EXPECT_FALSE(curves[0].points[0].own_front);
    EXPECT_FALSE(curves[1].points[0].own_front);
}

// Cycles: 0.1 at 1 s, 0.01 at 10 s. Ratios by hand: 0.1 s for 0.03162 (Cycles 3.162 s) is 31.62; 0.2 s for
// 0.01 is 50; 2 s for 0.001 is 50, beyond Cycles' last point.
TEST(SummarizeFront, GeometricMeanAndWorstOverTheOwnFront) {
    std::vector<Curve> curves{{"Cycles", true, {point("1", 1.0, 0.1), point("10", 10.0, 0.01)}},
                              {"Bounce",
                               false,
                               {own_point("a", 0.1, std::sqrt(0.001)), own_point("b", 0.2, 0.01),
                                own_point("c", 2.0, 0.001), own_point("beaten", 0.3, 0.05)}}};
    mark_pareto(curves);
    const FrontSummary summary = summarize_front(curves, speedups_at_equal_error(curves));
    EXPECT_EQ(summary.points, 3U);
    EXPECT_EQ(summary.compared, 3U);
    EXPECT_EQ(summary.extrapolated, 1U);
    EXPECT_EQ(summary.upper_bounds, 0U);
    EXPECT_NEAR(summary.geometric_mean_ratio, std::cbrt(31.6227766 * 50.0 * 50.0), 1e-6);
    EXPECT_NEAR(summary.least_ratio, 31.6227766, 1e-6);
    EXPECT_EQ(summary.least_label, "a");
}

TEST(SummarizeFront, CountsUpperBoundsAndIsNaNWithoutALadder) {
    std::vector<Curve> curves{{"Cycles", true, {point("1", 1.0, 0.1), point("10", 10.0, 0.01)}},
                              {"Bounce", false, {own_point("a", 0.1, 0.5)}}};
    mark_pareto(curves);
    const FrontSummary bound = summarize_front(curves, speedups_at_equal_error(curves));
    EXPECT_EQ(bound.upper_bounds, 1U);
    EXPECT_NEAR(bound.least_ratio, 10.0, 1e-9);
    curves.erase(curves.begin());
    const FrontSummary none = summarize_front(curves, speedups_at_equal_error(curves));
    EXPECT_EQ(none.points, 1U);
    EXPECT_EQ(none.compared, 0U);
    EXPECT_TRUE(std::isnan(none.geometric_mean_ratio));
    EXPECT_TRUE(std::isnan(none.least_ratio));
}

}  // namespace
}  // namespace bounce
