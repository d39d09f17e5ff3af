// SPDX-License-Identifier: Apache-2.0
#include "evaluate/hdr_flip_of_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "image/metrics.h"

namespace bounce {
namespace {

Image constant(float value) {
    Image image(8, 4);
    std::fill(image.rgb.begin(), image.rgb.end(), value);
    return image;
}

// Two points of one curve over two frames, of which the page shows the more exact second one.
struct Example {
    std::vector<Image> pictures{constant(0.2F), constant(0.3F), constant(0.4F), constant(0.45F)};
    Evaluation evaluation;
    std::vector<RenderedPoint> points;

    Example() {
        evaluation.references = {{1, constant(0.5F), 0.0, 1.0}, {2, constant(0.6F), 0.0, 1.0}};
        const auto point = [](const char* label, double relmse) {
            return make_point(label, {{1, 0.1, relmse}, {2, 0.1, relmse}});
        };
        evaluation.curves = {{"ISM", false, {point("64", 0.3), point("256", 0.1)}}};
        for (size_t i = 0; i < 2; ++i) {
            points.push_back(
                {0, i, {{1, 0.1, {}, &pictures[2 * i], {}}, {2, 0.1, {}, &pictures[2 * i + 1], {}}}});
        }
    }
    [[nodiscard]] const CurvePoint& point(size_t index) const { return evaluation.curves[0].points[index]; }
};

TEST(HdrFlipOfPoints, IsTheFigureOfCompare) {
    Example example;
    fill_hdr_flip(example.evaluation, example.points);
    for (size_t i = 0; i < 2; ++i) {
        double sum = 0.0;
        for (size_t k = 0; k < 2; ++k) {
            const Metrics metrics =
                compare(example.pictures[2 * i + k], example.evaluation.references[k].image);
            EXPECT_EQ(example.point(i).frames[k].flip_hdr, metrics.flip_hdr);
            EXPECT_GT(metrics.flip_hdr, 0.0);
            sum += metrics.flip_hdr;
        }
        EXPECT_DOUBLE_EQ(example.point(i).flip_hdr, sum / 2);
    }
}

TEST(HdrFlipOfPoints, WhereItTakesLongOnlyOfWhatIsShown) {
    Example example;
    // Two pictures and a reference of 32 pixels at two exposures, in each of two frames.
    fill_hdr_flip(example.evaluation, example.points, 2 * 3 * 32 * 2 - 1);
    EXPECT_TRUE(std::isnan(example.point(0).flip_hdr));
    EXPECT_TRUE(std::isnan(example.point(0).frames[0].flip_hdr));
    EXPECT_TRUE(std::isfinite(example.point(1).flip_hdr));
    Example whole;
    fill_hdr_flip(whole.evaluation, whole.points, 2 * 3 * 32 * 2);
    EXPECT_TRUE(std::isfinite(whole.point(0).flip_hdr));
}

TEST(HdrFlipOfPoints, AFrameWithAValueThatIsNoNumberHasNone) {
    Example example;
    example.pictures[0].rgb[5] = std::numeric_limits<float>::quiet_NaN();
    example.evaluation.curves[0].points[0].frames[0].not_finite = 1;
    fill_hdr_flip(example.evaluation, example.points);
    EXPECT_TRUE(std::isnan(example.point(0).frames[0].flip_hdr));
    EXPECT_TRUE(std::isfinite(example.point(0).frames[1].flip_hdr));
    EXPECT_TRUE(std::isnan(example.point(0).flip_hdr));
}

}  // namespace
}  // namespace bounce
