// SPDX-License-Identifier: Apache-2.0
#include "image/flip.h"

#include <cmath>

#include <gtest/gtest.h>

#include "image/flip_color.h"
#include "image/heatmap.h"

namespace bounce {
namespace {

Image constant(int width, int height, float red, float green, float blue) {
    Image image(width, height);
    for (size_t i = 0; i < image.rgb.size(); i += 3) {
        image.rgb[i] = red;
        image.rgb[i + 1] = green;
        image.rgb[i + 2] = blue;
    }
    return image;
}

struct Pair {
    Image test{64, 48};
    Image reference{64, 48};
};

// A pattern with edges, points and colour errors at many scales, from whole numbers, so that another
// implementation can be given the very same values.
Pair pattern(bool hdr) {
    Pair pair;
    for (int y = 0; y < 48; ++y) {
        for (int x = 0; x < 64; ++x) {
            const auto fraction = [](int value, int modulus) {
                return static_cast<float>(value % modulus) / static_cast<float>(modulus - 1);
            };
            const int checker = (x / 8 + y / 8) % 2;
            const float scale = hdr ? 0.01F + static_cast<float>(x * y) / 64.0F : 1.0F;
            const float green = fraction(x * x + y, 23);
            const float blue = fraction(x + 2 * y, 31);
            float* reference = &pair.reference.rgb[pair.reference.offset(x, y)];
            reference[0] = fraction(x * 7 + y * 3, 17) * scale;
            reference[1] = green * scale;
            reference[2] = blue * scale;
            float* test = &pair.test.rgb[pair.test.offset(x, y)];
            test[0] = fraction(x * 7 + y * 3 + checker, 17) * scale;
            test[1] = green * 0.9F * scale;
            test[2] = (y > 24 ? blue : blue * 0.5F + 0.25F) * scale;
        }
    }
    return pair;
}

float at(const Plane& plane, int x, int y) {
    return plane.values[static_cast<size_t>(y * plane.width + x)];
}

// The expected numbers of the next three tests were computed by NVIDIA's FLIP 1.6 (FLIP.h, CPU) on the
// same values. It works in single precision; the last digits depend on the order of its sums.
TEST(Flip, AgreesWithTheAuthorsProgramOnLdr) {
    const Pair pair = pattern(false);
    const Plane error = flip_ldr(pair.test, pair.reference);
    EXPECT_NEAR(mean(error), 0.3566645, 2e-5);
    EXPECT_NEAR(at(error, 5, 7), 0.3494687, 2e-5);
    EXPECT_NEAR(at(error, 63, 47), 0.3186531, 2e-5);
}

TEST(Flip, AgreesWithTheAuthorsProgramAtAnotherViewingDistance) {
    const Pair pair = pattern(false);
    const Plane error = flip_ldr(pair.test, pair.reference, 30.0F);
    EXPECT_NEAR(mean(error), 0.3996378, 2e-5);
    EXPECT_NEAR(at(error, 5, 7), 0.2816509, 2e-5);
}

TEST(Flip, AgreesWithTheAuthorsProgramOnHdr) {
    const Pair pair = pattern(true);
    const FlipExposures exposures = flip_exposures(pair.reference);
    EXPECT_NEAR(exposures.start, -4.235524, 1e-5);
    EXPECT_NEAR(exposures.stop, -0.767649, 1e-5);
    EXPECT_EQ(exposures.count, 4);
    const Plane error = flip_hdr(pair.test, pair.reference);
    EXPECT_NEAR(mean(error), 0.2173851, 2e-5);
    EXPECT_NEAR(at(error, 5, 7), 0.1642006, 2e-5);
    EXPECT_NEAR(at(error, 63, 47), 0.1479451, 2e-5);
}

// To the bit, whichever is asked.
TEST(Flip, WhatIsLookedAtOnceHasTheSameError) {
    const Pair pair = pattern(true);
    const HdrFlipReference reference(pair.reference);
    EXPECT_EQ(reference.error_of(pair.test).values, flip_hdr(pair.test, pair.reference).values);
    const Image grey = constant(pair.test.width, pair.test.height, 0.2F, 0.2F, 0.2F);
    EXPECT_EQ(reference.error_of(grey).values, flip_hdr(grey, pair.reference).values);
    const Pair display = pattern(false);
    EXPECT_EQ(flip_ldr(perceived(display.test), perceived(display.reference)).values,
              flip_ldr(display.test, display.reference).values);
}

TEST(Flip, EqualImagesHaveNoError) {
    const Pair pair = pattern(true);
    EXPECT_EQ(mean(flip_ldr(pair.test, pair.test)), 0.0);
    EXPECT_EQ(mean(flip_hdr(pair.test, pair.test)), 0.0);
}

// Green against blue is the largest difference there is and defines 1.
TEST(Flip, GreenAgainstBlueIsOne) {
    const Plane error = flip_ldr(constant(9, 9, 0, 1, 0), constant(9, 9, 0, 0, 1));
    EXPECT_NEAR(mean(error), 1.0, 1e-5);
}

// Black against white differs by 100 in L alone: 100^0.7 = 25.1189 of the largest 41.2760, past the knee
// at 0.4 of it: 0.95 + (25.1189 - 16.5104) / (41.2760 - 16.5104) * 0.05 = 0.96738.
TEST(Flip, BlackAgainstWhiteByHand) {
    const Plane error = flip_ldr(constant(9, 9, 0, 0, 0), constant(9, 9, 1, 1, 1));
    EXPECT_NEAR(mean(error), 0.96738, 1e-5);
}

TEST(Flip, ColorSpacesByHand) {
    // White is L = 100 without chroma in both spaces; black is L = 0, and Y = -16 in the linear one.
    const glm::vec3 white = flip::lab_from_linear({1, 1, 1});
    EXPECT_NEAR(white.x, 100.0F, 1e-4);
    EXPECT_NEAR(white.y, 0.0F, 1e-3);
    EXPECT_NEAR(white.z, 0.0F, 1e-3);
    EXPECT_NEAR(flip::lab_from_linear({0, 0, 0}).x, 0.0F, 1e-4);
    EXPECT_NEAR(flip::ycxcz_from_linear({0, 0, 0}).x, -16.0F, 1e-4);
    // Red in CIELab under D65, as in colour tables.
    const glm::vec3 red = flip::lab_from_linear({1, 0, 0});
    EXPECT_NEAR(red.x, 53.24F, 0.01F);
    EXPECT_NEAR(red.y, 80.09F, 0.02F);
    EXPECT_NEAR(red.z, 67.20F, 0.02F);
    const glm::vec3 color{0.2F, 0.7F, 0.05F};
    const glm::vec3 back = flip::linear_from_ycxcz(flip::ycxcz_from_linear(color));
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(back[channel], color[channel], 1e-5);
    }
    EXPECT_FLOAT_EQ(flip::hyab({1, 0, 0}, {3, 3, 4}), 7.0F);
}

TEST(Flip, MostlyBlackReferenceHasFiniteExposures) {
    Image reference = constant(8, 8, 0, 0, 0);
    reference.rgb[0] = 100.0F;
    const FlipExposures exposures = flip_exposures(reference);
    EXPECT_NEAR(exposures.stop - exposures.start, 16.0F, 1e-4);
    EXPECT_TRUE(std::isfinite(mean(flip_hdr(constant(8, 8, .1F, .1F, .1F), reference))));
}

TEST(Heatmap, RunsFromBlackToPaleYellow) {
    Plane plane(4, 1);
    plane.values = {0.0F, 1.0F, 0.5F, std::nanf("")};
    const Image colors = magma(plane);
    EXPECT_LT(colors.rgb[0] + colors.rgb[1] + colors.rgb[2], 0.05F);
    EXPECT_GT(colors.rgb[3] + colors.rgb[4] + colors.rgb[5], 2.7F);
    // matplotlib's magma at 0.5, halfway between entries 127 and 128.
    EXPECT_NEAR(colors.rgb[6], 0.7133F, 0.01F);
    EXPECT_NEAR(colors.rgb[7], 0.2149F, 0.01F);
    EXPECT_NEAR(colors.rgb[8], 0.4751F, 0.01F);
    EXPECT_EQ(colors.rgb[9], colors.rgb[3]) << "NaN must not look like no error";
}

TEST(Heatmap, DifferenceIsFourTimes) {
    const Image difference =
        magnified_difference(constant(1, 1, 0.5F, 0.5F, 1.0F), constant(1, 1, 0.4F, 0.6F, 0.0F));
    EXPECT_NEAR(difference.rgb[0], 0.4F, 1e-6);
    EXPECT_NEAR(difference.rgb[1], 0.4F, 1e-6);
    EXPECT_EQ(difference.rgb[2], 1.0F);
}

TEST(Heatmap, MeanSquareOfRelativeErrorIsRelmse) {
    const Plane error = relative_error(constant(2, 2, 0.2F, 0.5F, 1.0F), constant(2, 2, 0.1F, 0.5F, 2.0F));
    EXPECT_NEAR(error.values[0] * error.values[0], 0.249792F, 1e-5);
}

}  // namespace
}  // namespace bounce
