// SPDX-License-Identifier: Apache-2.0
#include "renderer/converge.h"

#include <limits>

#include <gtest/gtest.h>

#include "passes/pixel_filter.h"

namespace bounce {
namespace {

TEST(Converge, BoundsOfAVarianceAreThoseOfChiSquared) {
    // Degrees of freedom; quantiles of chi-squared at 0.025 and 0.975 (any table).
    struct Row {
        int freedom;
        double low;
        double high;
    };
    for (const Row& row : {Row{3, 0.2158, 9.3484}, Row{9, 2.7004, 19.0228}, Row{29, 16.0471, 45.7223},
                           Row{99, 73.361, 128.422}}) {
        const VarianceBounds bounds = variance_bounds(row.freedom + 1);
        // Wilson and Hilferty's approximation is off by a tenth at 3 degrees of freedom and by a thousandth
        // at 29.
        const double tolerance = row.freedom < 9 ? 0.2 : 0.02;
        EXPECT_NEAR(bounds.low, row.freedom / row.high, tolerance * row.freedom / row.high) << row.freedom;
        EXPECT_NEAR(bounds.high, row.freedom / row.low, tolerance * row.freedom / row.low) << row.freedom;
    }
    EXPECT_GT(variance_bounds(2).high, 100.0);
    EXPECT_TRUE(std::isfinite(variance_bounds(2).high));
}

TEST(Converge, PassesLookByThePixelFilter) {
    EXPECT_EQ(converge_offset(1), glm::dvec2(0.0));
    for (int i = 2; i <= k_smoothed_passes; ++i) {
        EXPECT_LE(std::abs(converge_offset(i).x), 0.25);
        EXPECT_LE(std::abs(converge_offset(i).y), 0.25);
    }
    // The filter's variance along an axis, by a sum over its quantiles.
    double variance = 0.0;
    const int steps = 4096;
    for (int i = 0; i < steps; ++i) {
        const double at = passes::pixel_filter_quantile((i + 0.5) / steps);
        variance += at * at / steps;
    }
    glm::dvec2 mean(0.0);
    glm::dvec2 squares(0.0);
    const int count = 256;
    for (int i = 1; i <= count; ++i) {
        const glm::dvec2 at = converge_offset(k_smoothed_passes + i);
        mean += at / static_cast<double>(count);
        squares += at * at / static_cast<double>(count);
    }
    // Scrambled Sobol points: errors fall with the count; 256 random ones would be off by 0.03 and by 0.08 of
    // the variance.
    for (int axis = 0; axis < 2; ++axis) {
        EXPECT_NEAR(mean[axis], 0.0, 0.01);
        EXPECT_NEAR(squares[axis], variance, 0.02 * variance);
    }
}

TEST(Converge, WhatBoundsTakeVanishes) {
    EXPECT_EQ(converge_extent(1), 1.0);
    EXPECT_DOUBLE_EQ(converge_extent(8), 0.5);
    EXPECT_LT(converge_extent(1'000'000), 0.02);
}

TEST(Converge, MapsGrowWithinLimits) {
    Settings asked;
    asked.shadow_size = 2048;
    asked.ism_size = 64;
    constexpr int most = 4096;
    const Settings first = converge_settings(asked, 1, most);
    EXPECT_TRUE(first.antialias);
    EXPECT_EQ(first.samples, 1);
    EXPECT_EQ(first.shadow_size, asked.shadow_size);
    EXPECT_EQ(first.used_shadow_samples(), asked.used_shadow_samples());
    int before_shadow = 0;
    int before_map = 0;
    int before_rsm = 0;
    for (int number = 1; number < 2000; number *= 2) {
        const Settings now = converge_settings(asked, number, most);
        EXPECT_GE(now.shadow_size, before_shadow);
        EXPECT_GE(now.ism_size, before_map);
        EXPECT_GE(now.used_rsm_size(), before_rsm);
        EXPECT_LE(now.shadow_size, most);
        EXPECT_LE(now.ism_size, 256);
        before_shadow = now.shadow_size;
        before_map = now.ism_size;
        before_rsm = now.used_rsm_size();
    }
    EXPECT_EQ(before_shadow, most);
    EXPECT_EQ(before_map, 256);
    EXPECT_EQ(before_rsm, 1024);
    // What was asked for beyond the limits of growth is kept.
    asked.rsm_size = 2048;
    EXPECT_EQ(converge_settings(asked, 100, most).used_rsm_size(), 2048);
    asked.antialias = false;
    EXPECT_FALSE(converge_settings(asked, 1, most).antialias);
}

TEST(Converge, RefusesLightsThatDoNotConverge) {
    EXPECT_EQ(converge_refusal({}), "");
    for (const VplSampling biased : {VplSampling::metropolis, VplSampling::metropolis_unreduced}) {
        EXPECT_NE(converge_refusal({.vpl_sampling = biased}).find("resampled"), std::string::npos);
        EXPECT_EQ(converge_refusal({.technique = Technique::direct, .vpl_sampling = biased}), "");
    }
    for (const VplSampling right : {VplSampling::inverse3, VplSampling::uniform3, VplSampling::resampled,
                                    VplSampling::metropolis_single}) {
        EXPECT_EQ(converge_refusal({.vpl_sampling = right}), "");
    }
    Settings seen{.vpl_importance = Importance::view};
    EXPECT_EQ(converge_refusal(seen), "");
    seen.importance_floor = 0.0F;
    EXPECT_NE(converge_refusal(seen).find("--importance-floor"), std::string::npos);
}

TEST(Converge, KnowsWhatIsOutOfReach) {
    // A thousandth of the error takes a thousand times the passes.
    EXPECT_DOUBLE_EQ(least_wait_s(1e-2, 1e-5, 2.0), 2.0 * 999.0);
    EXPECT_EQ(least_wait_s(1e-3, 1e-2, 2.0), 0.0);
    Converged converged;
    converged.state = {16, 2.0, 1e-2, 5e-3, 2e-2};
    converged.end = ConvergeEnd::out_of_reach;
    const std::string far = describe(converged, {.relmse = 1e-9});
    EXPECT_NE(far.find("was not reached and would take 5556 more hours at least"), std::string::npos) << far;
    converged.state.relmse = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(describe(converged, {.relmse = 1e-9}).find("not a number"), std::string::npos);
}

TEST(Converge, SaysWhatWasReached) {
    Converged converged;
    converged.state = {12, 3.5, 2e-3, 1e-3, 5e-3};
    converged.end = ConvergeEnd::seconds;
    const std::string missed = describe(converged, {.seconds = 3.5, .relmse = 1e-3});
    EXPECT_NE(missed.find("12 passes in 3.50 s"), std::string::npos) << missed;
    EXPECT_NE(missed.find("2.00e-03"), std::string::npos) << missed;
    EXPECT_NE(missed.find("not reached"), std::string::npos) << missed;
    converged.end = ConvergeEnd::relmse;
    EXPECT_EQ(describe(converged, {.relmse = 2e-3}).find("not reached"), std::string::npos);
    converged.state = {1, 0.5, -1.0, -1.0, -1.0};
    EXPECT_NE(describe(converged, {}).find("1 pass "), std::string::npos);
}

}  // namespace
}  // namespace bounce
