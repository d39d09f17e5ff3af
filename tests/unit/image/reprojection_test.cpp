// SPDX-License-Identifier: Apache-2.0
#include "image/reprojection.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace bounce {
namespace {

constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();

Plane row(std::vector<float> values) {
    Plane plane(static_cast<int>(values.size()), 1);
    plane.values = std::move(values);
    return plane;
}

// Motion of every pixel: dx, dy, depth.
Image motion(int width, float dx, float dy, float depth) {
    Image image(width, 1);
    for (size_t i = 0; i < image.rgb.size(); i += 3) {
        image.rgb[i] = dx;
        image.rgb[i + 1] = dy;
        image.rgb[i + 2] = depth;
    }
    return image;
}

// Everything has moved one pixel to the right, so each pixel stood one to the left before; the first one was
// outside. One value has changed by 0.5 on the way.
TEST(Reprojection, WholePixelsByHand) {
    const auto sums = reprojected_difference(row({9, 1, 2.5F, 3}), row({1, 2, 3, 4}), motion(4, -1, 0, 5));
    EXPECT_EQ(sums.matched, 3U);
    EXPECT_NEAR(sums.squared, 0.25, 1e-12);
}

// Between two pixels both count: at 0.25 to the right of 1 lies 1 + 0.25 * 2.
TEST(Reprojection, BetweenPixelsByHand) {
    const auto sums = reprojected_difference(row({1.5F, 0, 0}), row({1, 3, 7}), motion(3, 0.25F, 0, 5));
    EXPECT_EQ(sums.matched, 2U) << "the last one would need a pixel outside";
    EXPECT_NEAR(sums.squared, 0.0 + 16.0, 1e-12);  // second: 3 + 0.25 * 4 against 0
}

// Rounding of a motion must not bring a pixel's neighbours in.
TEST(Reprojection, AlmostWholePixelsAreWhole) {
    const auto sums = reprojected_difference(row({1, 2, 3}), row({1, 2, 3}), motion(3, 1e-4F, -1e-4F, 5));
    EXPECT_EQ(sums.matched, 3U);
    EXPECT_EQ(sums.squared, 0.0);
}

TEST(Reprojection, WhatWasNotSeenHasNoMatch) {
    Image moves = motion(6, 0, 0, 5);
    moves.rgb[2] = 0.0F;       // hidden
    moves.rgb[3 * 1] = k_nan;  // broken
    moves.rgb[3 * 2] = 1e30F;  // far outside
    moves.rgb[3 * 3 + 1] = -std::numeric_limits<float>::infinity();
    moves.rgb[3 * 4 + 2] = k_nan;
    const auto sums = reprojected_difference(row({9, 9, 9, 9, 9, 2}), row({1, 1, 1, 1, 1, 1}), moves);
    EXPECT_EQ(sums.matched, 1U);
    EXPECT_NEAR(sums.squared, 1.0, 1e-12);
}

TEST(Reprojection, StillPixelsAreThoseThatDoNotMove) {
    Image moves = motion(4, 0, 0, 5);
    moves.rgb[3] = 0.02F;
    moves.rgb[3 * 2 + 2] = 0.0F;
    std::vector<char> mask{1, 1, 1, 0};
    keep_still_pixels(moves, mask);
    EXPECT_EQ(mask, (std::vector<char>{1, 0, 0, 0}));
}

}  // namespace
}  // namespace bounce
