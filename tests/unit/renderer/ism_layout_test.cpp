// SPDX-License-Identifier: Apache-2.0
#include "renderer/ism_layout.h"

#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

namespace bounce {
namespace {

Settings with(int vpls, int interleave, int map_size = 64) {
    Settings settings;
    settings.vpls = vpls;
    settings.bounce_vpls = vpls;
    settings.interleave = interleave;
    settings.ism_size = map_size;
    return settings;
}

TEST(IsmLayout, CountsAreRoundedUpToWholeSubsets) {
    for (const int n : {1, 2, 4, 8, 16}) {
        for (const int wanted : {1, 2, 15, 16, 17, 100, 255, 256, 257, 1024, 4096}) {
            const IsmLayout layout = ism_layout(with(wanted, n), 1, 512);
            EXPECT_EQ(layout.vpls % (n * n), 0);
            EXPECT_GE(layout.vpls, wanted);
            EXPECT_LT(layout.vpls - wanted, n * n) << "no more than that";
            EXPECT_EQ(layout.subset * n * n, layout.vpls);
            EXPECT_EQ(layout.interleave, n);
        }
    }
    EXPECT_EQ(ism_layout(with(256, 4), 1, 512).vpls, 256);
    EXPECT_EQ(ism_layout(with(100, 4), 1, 512).vpls, 112);
    EXPECT_EQ(ism_layout(with(1, 16), 1, 512).vpls, 256);
}

TEST(IsmLayout, LaterBouncesHaveTheirOwnCount) {
    Settings settings = with(256, 4);
    settings.bounce_vpls = 64;
    EXPECT_EQ(ism_layout(settings, 1, 512).vpls, 256);
    EXPECT_EQ(ism_layout(settings, 2, 512).vpls, 64);
    EXPECT_EQ(ism_layout(settings, 4, 512).vpls, 64);
    EXPECT_EQ(ism_layout(settings, 3, 512).cell_columns, 1) << "strips: a row is a place";
}

TEST(IsmLayout, CellsTileTheSquareOnceEach) {
    // As shaders/passes/vpl_draw.comp gives cells to lights.
    for (const int bounce : {1, 2}) {
        for (const int n : {1, 2, 4, 8, 16}) {
            for (const int wanted : {1, 16, 48, 100, 256, 1000}) {
                const IsmLayout layout = ism_layout(with(wanted, n), bounce, 512);
                ASSERT_EQ(layout.subset % layout.cell_columns, 0);
                std::set<std::pair<int, int>> cells;
                for (int i = 0; i < layout.vpls; ++i) {
                    const int subset = i / layout.subset;
                    const int k = i % layout.subset;
                    cells.emplace(k % layout.cell_columns * n + subset % n,
                                  k / layout.cell_columns * n + subset / n);
                }
                EXPECT_EQ(cells.size(), static_cast<size_t>(layout.vpls)) << "no cell twice";
                const int columns = layout.cell_columns * n;
                const int rows = layout.subset / layout.cell_columns * n;
                EXPECT_EQ(columns * rows, layout.vpls);
                for (const auto& [x, y] : cells) {
                    ASSERT_LT(x, columns);
                    ASSERT_LT(y, rows);
                }
            }
        }
    }
    EXPECT_EQ(ism_layout(with(256, 4), 1, 512).cell_columns, 4) << "16 lights a subset: 4 by 4";
    EXPECT_EQ(ism_layout(with(192, 4), 1, 512).cell_columns, 3) << "12: 3 by 4";
}

TEST(IsmLayout, MapsLieInTheAtlasSideBySide) {
    for (const int size : {32, 64, 128, 256}) {
        for (const int wanted : {1, 2, 3, 16, 100, 1024}) {
            const IsmLayout layout = ism_layout(with(wanted, 1, size), 1, 512);
            EXPECT_EQ(layout.map_size, size);
            EXPECT_GE(layout.columns * layout.rows(), layout.vpls);
            EXPECT_EQ(layout.atlas_width(), layout.columns * size);
            EXPECT_EQ(layout.atlas_height(), layout.rows() * size);
            EXPECT_LT((layout.rows() - 1) * layout.columns, layout.vpls) << "no empty row";
            EXPECT_LE(layout.columns - layout.rows(), 1) << "about square";
        }
    }
    // 4,096 maps of 256 by 256, the most asked for: within the 16,384 that drivers promise.
    EXPECT_EQ(ism_layout(with(4096, 4, 256), 1, 512).atlas_width(), 16384);
}

TEST(IsmLayout, UniformsSayWhatTheLayoutSays) {
    Settings settings = with(100, 2, 128);
    const IsmLayout layout = ism_layout(settings, 1, 700);
    const gpu::IsmUniforms disks = ism_uniforms(layout, settings, 70000, 0.01);
    EXPECT_EQ(disks.atlas, glm::ivec4(128, layout.columns, 100, 700));
    EXPECT_EQ(disks.points.x, 70000);
    EXPECT_EQ(disks.points.y, 0);
    EXPECT_EQ(disks.gather, glm::ivec4(2, 25, 5, 0));
    // A point stands for a 70,000th of the area, in a map for a 700th: 100 times, and disks overlap.
    EXPECT_GT(disks.splat.x, 100.0F);
    EXPECT_LT(disks.splat.x, 200.0F);
    EXPECT_EQ(disks.splat.z, 0.0F) << "disks need no bias: their planes are exact";
    EXPECT_EQ(disks.splat.w, 0.0F);
    settings.splat = Splat::compute;
    const gpu::IsmUniforms squares = ism_uniforms(layout, settings, 70000, 0.01);
    EXPECT_NEAR(squares.splat.x, 100.0F, 1e-3F);
    EXPECT_GT(squares.splat.z, 0.0F) << "one depth a splat needs one";
    EXPECT_GT(squares.splat.w, 0.0F);
    const gpu::IsmUniforms reflective = irsm_uniforms(layout, {}, 7000, 70000, 0.0);
    EXPECT_EQ(reflective.points.x, 7000);
    EXPECT_EQ(reflective.points.y, 70000) << "reflectors stand behind the occluders";
    EXPECT_NEAR(reflective.splat.x, 10.0F, 1e-4F);
}

TEST(IsmPoints, AQuarterOfTheTexelsTimesTheComplexity) {
    // pi / 4 of a map's texels are used: 64 x 64 has 3,217, and 804.2 points.
    EXPECT_EQ(automatic_points(64, 1.0), 805);
    EXPECT_EQ(automatic_points(64, 0.2), 805) << "never less than one surface";
    EXPECT_EQ(automatic_points(64, 3.0), 2413);
    EXPECT_EQ(automatic_points(256, 2.0),
              static_cast<int>(std::ceil(0.25 * std::numbers::pi / 4.0 * 65536.0 * 2.0)));
    EXPECT_EQ(automatic_points(32, 1.0), 512) << "not fewer";
    EXPECT_EQ(automatic_points(256, 1e9), 65536) << "not more";
    EXPECT_EQ(automatic_points(256, 1e300), 65536);
}

TEST(IsmPoints, ComplexityOfABoxIsTwo) {
    // Every line through a closed convex box crosses it twice.
    EXPECT_DOUBLE_EQ(depth_complexity(6.0, 6.0), 2.0);
    EXPECT_EQ(depth_complexity(1.0, 0.0), 0.0) << "a flat scene has no inside";
    EXPECT_EQ(depth_complexity(0.0, 0.0), 0.0);
}

TEST(IsmPoints, ComplexityIsWhatRandomLinesMeet) {
    // Crofton's formula against lines: through a box of 2 x 3 x 4 with a wall and a small box inside. Lines
    // that are uniform and isotropic: a random direction, through a random point of the disk across it.
    const glm::dvec3 half(1.0, 1.5, 2.0);
    const glm::dvec3 inner(0.3, 0.5, 0.2);
    const double wall = 2.0 * 3.0;  // y in -1 to 1, z in -1.5 to 1.5 at x = 0.4, apart from the small box
    const auto surface = [](const glm::dvec3& h) { return 8.0 * (h.x * h.y + h.y * h.z + h.z * h.x); };
    const auto hits = [](const glm::dvec3& from, const glm::dvec3& along, const glm::dvec3& h) {
        double low = -1e300;
        double high = 1e300;
        for (int axis = 0; axis < 3; ++axis) {
            const double a = (-h[axis] - from[axis]) / along[axis];
            const double b = (h[axis] - from[axis]) / along[axis];
            low = std::max(low, std::min(a, b));
            high = std::min(high, std::max(a, b));
        }
        return low < high;
    };
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform(-3.0, 3.0);
    double lines = 0.0;
    double met = 0.0;
    while (lines < 200000.0) {
        const glm::dvec3 along = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
        glm::dvec3 from(0.0);
        do {
            from = {uniform(random), uniform(random), uniform(random)};
        } while (glm::dot(from, from) > 9.0);
        // Points uniform in a ball, moved along the direction, are not uniform in its disk; weigh by the
        // chord.
        const double off = glm::length(from - along * glm::dot(from, along));
        if (std::abs(uniform(random)) > 3.0 * 0.2 / std::max(std::sqrt(9.0 - off * off), 0.6)) {
            continue;
        }
        if (!hits(from, along, half)) {
            continue;
        }
        lines += 1.0;
        met += hits(from - glm::dvec3(-0.4, 0.0, 0.0), along, inner) ? 2.0 : 0.0;
        const double t = (0.4 - from.x) / along.x;
        met += std::abs(from.y + t * along.y) < 1.0 && std::abs(from.z + t * along.z) < 1.5 ? 1.0 : 0.0;
    }
    EXPECT_NEAR(met / lines / depth_complexity(wall + surface(inner), surface(half)), 1.0, 0.02)
        << "noise of 200,000 lines is half of a percent";
}

TEST(IsmPoints, EachMapHasItsOwnAsFarAsMemoryGoes) {
    IsmLayout layout = ism_layout(with(256, 4), 1, 805);
    EXPECT_EQ(points_in_all(layout), 805U * 256U);
    layout = ism_layout(with(4096, 4), 1, 8192);
    EXPECT_EQ(points_in_all(layout) * sizeof(glm::uvec4), size_t{64} << 20U) << "64 MiB, and maps share";
    layout.points_a_map = 0;
    EXPECT_EQ(points_in_all(layout), 0U);
}

}  // namespace
}  // namespace bounce
