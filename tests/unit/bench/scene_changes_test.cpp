// SPDX-License-Identifier: Apache-2.0
#include "bench/scene_changes.h"

#include <limits>

#include <gtest/gtest.h>

#include "bench/furnace_room.h"

namespace bounce::bench {
namespace {

Image grey(float value) {
    Image image(8, 4);
    std::fill(image.rgb.begin(), image.rgb.end(), value);
    return image;
}

TEST(SceneChanges, DifferenceOfOnePixel) {
    const Image a = grey(2.0F);
    Image b = a;
    b.rgb[5] = 3.0F;
    const Difference d = difference(b, a);
    EXPECT_NEAR(d.worst, 1.0 / 2.02, 1e-9);
    EXPECT_NEAR(d.changed, 1.0 / 32.0, 1e-12);
    EXPECT_NEAR(d.bias, 1.0 / (2.0 * 96.0), 1e-9);
    EXPECT_GT(d.relmse, 0.0);
    EXPECT_EQ(difference(a, a).worst, 0.0);
}

TEST(SceneChanges, DifferenceOfMoreLight) {
    EXPECT_NEAR(difference(grey(2e6F), grey(2.0F), 1e6).worst, 0.0, 1e-6);
    EXPECT_GT(difference(grey(2.1e6F), grey(2.0F), 1e6).worst, 0.04);
}

TEST(SceneChanges, WhatIsAllowed) {
    Difference none;
    EXPECT_TRUE(holds(none, Allowed::nothing, 0.0, false));
    Difference little{.worst = 1e-7};
    EXPECT_FALSE(holds(little, Allowed::nothing, 1.0, true)) << "not a bit";
    EXPECT_TRUE(holds(little, Allowed::halves, 0.0, false));
    Difference noise{.worst = 0.5, .relmse = 1e-3};
    EXPECT_FALSE(holds(noise, Allowed::halves, 1e-2, true));
    EXPECT_FALSE(holds(noise, Allowed::rounding, 1e-2, false)) << "nothing is drawn anew";
    EXPECT_TRUE(holds(noise, Allowed::rounding, 1e-2, true));
    EXPECT_FALSE(holds(noise, Allowed::rounding, 1e-4, true)) << "more than its own noise";
    EXPECT_TRUE(holds(noise, Allowed::sampling, 0.0, false));
    Image bad = grey(1.0F);
    bad.rgb[3] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(holds(difference(bad, grey(1.0F)), Allowed::sampling, 1.0, true)) << "never";
}

TEST(Furnace, ExpectedRadiance) {
    const Furnace walls{FurnaceShape::cube, FurnaceLight::emission, 0.5F};
    EXPECT_NEAR(furnace_radiance(walls, 1), 1.75, 1e-12);
    EXPECT_NEAR(furnace_radiance(walls, 60), 2.0, 1e-12);
    const Furnace lamp{FurnaceShape::cube, FurnaceLight::point, 0.5F};
    EXPECT_NEAR(furnace_radiance(lamp, 1), 0.5 / 3.14159265 * 100.0 / 24.0 * 1.5, 1e-6);
    // A sphere of chords is a little smaller than 4 pi.
    const Furnace round{FurnaceShape::sphere, FurnaceLight::point, 0.5F};
    EXPECT_NEAR(furnace_radiance(round, 0), 0.5 / 3.14159265 * 100.0 / 12.566, 0.01);
}

}  // namespace
}  // namespace bounce::bench
