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

}  // namespace
}  // namespace bounce
