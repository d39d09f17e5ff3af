// SPDX-License-Identifier: Apache-2.0
#include "renderer/pixel_offsets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "passes/pixel_filter.h"
#include "renderer/sampled_picture.h"

namespace bounce {
namespace {

using passes::k_pixel_filter_width;
using passes::pixel_filter;
using passes::pixel_filter_quantile;

// Share of the filter's weight where `inside` says so, by a fine grid.
template <typename Inside>
double share(int dimensions, Inside inside) {
    const int steps = dimensions == 2 ? 150 : 6000;
    const auto place = [&](int i) { return ((i + 0.5) / steps - 0.5) * k_pixel_filter_width; };
    double sum = 0.0;
    double all = 0.0;
    for (int j = 0; j < (dimensions == 2 ? steps : 1); ++j) {
        for (int i = 0; i < steps; ++i) {
            const glm::dvec2 at(place(i), dimensions == 2 ? place(j) : 0.0);
            const double weight = pixel_filter(at.x) * (dimensions == 2 ? pixel_filter(at.y) : 1.0);
            all += weight;
            sum += inside(at) ? weight : 0.0;
        }
    }
    return sum / all;
}

TEST(PixelFilter, IsCyclesWindowOverThreePixels) {
    EXPECT_NEAR(pixel_filter(0.0), 1.0, 1e-12);  // the four terms add up to 1
    EXPECT_NEAR(pixel_filter(1.4999), 0.00006, 1e-6);
    EXPECT_EQ(pixel_filter(1.5), 0.0);
    EXPECT_EQ(pixel_filter(-2.0), 0.0);
    EXPECT_NEAR(pixel_filter(0.4), pixel_filter(-0.4), 1e-15);
}

TEST(PixelFilter, QuantilesInvertTheShareBelow) {
    EXPECT_EQ(pixel_filter_quantile(0.5), 0.0);
    for (const double u : {0.01, 0.1, 0.25, 0.4, 0.77, 0.999}) {
        const double at = pixel_filter_quantile(u);
        EXPECT_EQ(at, -pixel_filter_quantile(1.0 - u));
        EXPECT_NEAR(share(1, [&](const glm::dvec2& p) { return p.x < at; }), u, 3e-3) << u;
    }
    EXPECT_NEAR(pixel_filter_quantile(0.0), -1.5, 1e-9);
    EXPECT_NEAR(pixel_filter_quantile(1.0), 1.5, 1e-9);
}

TEST(PixelOffsets, OneFrameLooksAtTheMiddleToTheBit) {
    ASSERT_EQ(pixel_offsets(1).size(), 1U);
    EXPECT_EQ(pixel_offsets(1)[0], glm::dvec2(0.0));
}

class Counts : public testing::TestWithParam<int> {};

TEST_P(Counts, NoPictureIsDisplacedAndNoRowOrColumnIsLookedAtTwice) {
    std::vector<glm::dvec2> offsets = pixel_offsets(GetParam());
    ASSERT_EQ(offsets.size(), static_cast<size_t>(GetParam()));
    glm::dvec2 sum(0.0);
    for (const glm::dvec2& offset : offsets) {
        sum += offset;
    }
    EXPECT_NEAR(sum.x, 0.0, 1e-9);
    EXPECT_NEAR(sum.y, 0.0, 1e-9);
    for (const int axis : {0, 1}) {
        std::sort(offsets.begin(), offsets.end(),
                  [axis](const glm::dvec2& a, const glm::dvec2& b) { return a[axis] < b[axis]; });
        for (size_t i = 0; i < offsets.size(); ++i) {
            const double u = (static_cast<double>(i) + 0.5) / GetParam();
            EXPECT_NEAR(offsets[i][axis], pixel_filter_quantile(u), 1e-9);
        }
    }
}

// An edge at any angle through any place: N random samples would be wrong by 0.5 / sqrt(N) where half of the
// filter is covered, evenly spread ones by far less.
TEST_P(Counts, EdgesAreCoveredAsByTheFilter) {
    const int count = GetParam();
    const std::vector<glm::dvec2> offsets = pixel_offsets(count);
    double squares = 0.0;
    int cases = 0;
    for (int turn = 0; turn < 12; ++turn) {
        const double angle = (turn + 0.37) * std::numbers::pi / 12.0;
        const glm::dvec2 across(std::cos(angle), std::sin(angle));
        for (const double place : {-0.5, -0.2, 0.1, 0.4}) {
            const auto inside = [&](const glm::dvec2& p) { return glm::dot(p, across) < place; };
            const double hit = static_cast<double>(std::count_if(offsets.begin(), offsets.end(), inside));
            squares += std::pow(hit / count - share(2, inside), 2);
            ++cases;
        }
    }
    EXPECT_LT(std::sqrt(squares / cases), 0.9 * std::pow(count, -0.75) * 0.5);
}

INSTANTIATE_TEST_SUITE_P(PixelOffsets, Counts, testing::Values(4, 7, 16, 64, 100));

Image picture(float value) {
    Image image(2, 1);
    image.rgb.assign(image.rgb.size(), value);
    return image;
}

TEST(PictureMean, IsTheMeanOfLight) {
    PictureMean mean;
    for (const float value : {1.0F, 2.0F, 6.0F}) {
        mean.add(picture(value));
    }
    EXPECT_EQ(mean.mean().rgb, picture(3.0F).rgb);
    EXPECT_EQ(mean.faulty_pixels(), 0U);
}

TEST(PictureMean, ManySmallValuesAreNotLostBesideALargeOne) {
    PictureMean mean;
    mean.add(picture(1e8F));
    for (int i = 1; i < 1000; ++i) {
        mean.add(picture(1.0F));
    }
    EXPECT_FLOAT_EQ(mean.mean().rgb[0], 100000.999F);
}

TEST(PictureMean, AFaultOfOneSampleStaysVisible) {
    PictureMean mean;
    Image faulty = picture(1.0F);
    faulty.rgb[4] = std::numeric_limits<float>::quiet_NaN();
    mean.add(picture(1.0F));
    mean.add(faulty);
    EXPECT_EQ(mean.faulty_pixels(), 1U);
    EXPECT_TRUE(std::isnan(mean.mean().rgb[4]));
    EXPECT_EQ(mean.mean().rgb[3], 1.0F);
    EXPECT_EQ(mean.mean().rgb[5], 1.0F);
}

}  // namespace
}  // namespace bounce
