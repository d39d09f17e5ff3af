// SPDX-License-Identifier: Apache-2.0
//
// Points that tessellation makes on triangles: their number, their maps and their places, in GLSL.
#include <gtest/gtest.h>

#include "shader_harness.h"

namespace bounce::test {
namespace {

class PatchPoints : public ShaderTest {
  protected:
    struct Triangle {
        double count;
        double first_map;
    };
    // `triangles` of each of `draws` that are to have `wanted` points each.
    static std::vector<Triangle> points(int draws, int triangles, float wanted, float maps) {
        std::vector<glm::vec4> in;
        for (int d = 0; d < draws; ++d) {
            for (int t = 0; t < triangles; ++t) {
                in.emplace_back(d * 31 + 7, t, wanted, maps);
                in.emplace_back(0.0F);
            }
        }
        const std::vector<glm::vec4> out = run("patch_points.comp", 2, 2, in);
        std::vector<Triangle> all;
        for (size_t i = 0; i < out.size(); i += 2) {
            all.push_back({out[i].x, out[i].y});
        }
        return all;
    }
};

TEST_F(PatchPoints, AreAsManyAsTheAreaSays) {
    constexpr int draws = 50;
    constexpr int triangles = 2000;
    for (const double wanted : {1e-4, 0.003, 0.11, 0.5, 0.97, 1.0, 1.7, 5.3, 812.25}) {
        double sum = 0.0;
        for (const auto& t : points(draws, triangles, static_cast<float>(wanted), 64.0F)) {
            sum += t.count;
            ASSERT_TRUE(t.count == std::floor(wanted) || t.count == std::ceil(wanted)) << wanted;
        }
        // Each draw's are spread along a lattice, whose sums are off by a few points at most whatever their
        // number; from draw to draw independent.
        EXPECT_NEAR(sum, wanted * draws * triangles, 3.0 * std::sqrt(draws)) << wanted;
    }
}

TEST_F(PatchPoints, AreRightInEveryStretchOfADraw) {
    // Of independent numbers 25 in 100 would be off by 4.3 in the mean square.
    double squares = 0.0;
    const std::vector<Triangle> all = points(1, 10000, 0.25F, 64.0F);
    for (size_t first = 0; first < all.size(); first += 100) {
        double sum = 0.0;
        for (size_t i = first; i < first + 100; ++i) {
            sum += all[i].count;
        }
        squares += (sum - 25.0) * (sum - 25.0) / 100.0;
    }
    EXPECT_LT(std::sqrt(squares), 1.5);
}

TEST_F(PatchPoints, AreDealtToAllMapsAlike) {
    constexpr int maps = 64;
    for (const float wanted : {0.004F, 0.3F, 0.9F, 1.5F, 6.25F}) {
        std::vector<double> dealt(maps, 0.0);
        double sum = 0.0;
        for (const auto& t : points(40, 4000, wanted, maps)) {
            ASSERT_GE(t.first_map, 0.0);
            ASSERT_LT(t.first_map, maps);
            for (int k = 0; k < static_cast<int>(t.count); ++k) {
                dealt[static_cast<size_t>(t.first_map + k) % maps] += 1.0;
            }
            sum += t.count;
        }
        const double mean = sum / maps;
        for (const double count : dealt) {
            // Five standard deviations of numbers that were independent; the lattice stays far within them.
            EXPECT_NEAR(count, mean, 5.0 * std::sqrt(mean)) << wanted;
        }
    }
}

TEST_F(PatchPoints, AreTheSameEveryTimeAndOthersInAnotherDraw) {
    const std::vector<Triangle> first = points(2, 500, 0.5F, 256.0F);
    const std::vector<Triangle> again = points(2, 500, 0.5F, 256.0F);
    int other = 0;
    for (size_t i = 0; i < first.size(); ++i) {
        EXPECT_EQ(first[i].count, again[i].count);
        EXPECT_EQ(first[i].first_map, again[i].first_map);
        other += i < 500 && first[i].count != first[i + 500].count ? 1 : 0;
    }
    EXPECT_GT(other, 150) << "of 250 where the draws are independent";
}

TEST_F(PatchPoints, LieEvenlyOnATriangle) {
    // Within one map's points of one triangle, and over the maps.
    for (const bool one_map : {true, false}) {
        constexpr int count = 4096;
        std::vector<glm::vec4> in;
        for (int i = 0; i < count; ++i) {
            in.emplace_back(0.0F, 0.0F, 1.0F, 1.0F);
            in.emplace_back(4321.0F, one_map ? 5 : i, one_map ? i : 0, 0.0F);
        }
        const std::vector<glm::vec4> out = run("patch_points.comp", 2, 2, in);
        // Four triangles of a quarter of the area each; means; second moments.
        int quarter[4] = {0, 0, 0, 0};
        glm::dvec2 mean(0.0);
        glm::dvec3 moments(0.0);
        for (size_t i = 1; i < out.size(); i += 2) {
            const glm::dvec2 p(out[i].x, out[i].y);
            ASSERT_GE(p.x, 0.0);
            ASSERT_GE(p.y, 0.0);
            ASSERT_LE(p.x + p.y, 1.0 + 1e-6);
            ++quarter[p.x > 0.5 ? 1 : p.y > 0.5 ? 2 : p.x + p.y < 0.5 ? 3 : 0];
            mean += p / static_cast<double>(count);
            moments += glm::dvec3(p.x * p.x, p.y * p.y, p.x * p.y) / static_cast<double>(count);
        }
        // A lattice is off by a few points, independent ones by 28 in a quarter.
        const double tolerance = one_map ? 12.0 : 5.0 * 28.0;
        for (const int inside : quarter) {
            EXPECT_NEAR(inside, count / 4.0, tolerance) << one_map;
        }
        EXPECT_NEAR(mean.x, 1.0 / 3.0, one_map ? 2e-3 : 0.02);
        EXPECT_NEAR(mean.y, 1.0 / 3.0, one_map ? 2e-3 : 0.02);
        EXPECT_NEAR(moments.x, 1.0 / 6.0, one_map ? 2e-3 : 0.02);
        EXPECT_NEAR(moments.y, 1.0 / 6.0, one_map ? 2e-3 : 0.02);
        EXPECT_NEAR(moments.z, 1.0 / 12.0, one_map ? 2e-3 : 0.02);
    }
}

}  // namespace
}  // namespace bounce::test
