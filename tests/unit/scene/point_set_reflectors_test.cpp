// SPDX-License-Identifier: Apache-2.0
//
// Points that reflect: all of the area, along one curve through the scene's places.
#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "point_samples.h"
#include "scene/refine.h"

namespace bounce::scene::test {
namespace {

TEST(PointSet, RunsOfReflectorsFollowOneCurve) {
    const Scene scene = mixed_scene();
    const SurfaceParts parts = surface_parts(scene, k_all_animations);
    PointCounts counts;
    counts.reflectors_a_map = 128;
    counts.reflectors = 128 * 32;
    // What is on the hull reflects all the same.
    const PointSet set = sample_points(parts, std::vector<bool>(parts.parts.size(), true), counts);
    EXPECT_TRUE(set.occluders.empty());
    EXPECT_TRUE(set.large.empty());
    ASSERT_EQ(set.reflectors.size(), counts.reflectors);
    EXPECT_NEAR(set.reflector_area_m2 / parts.area_m2(), 1.0, 1e-9);
    double sum = 0.0;
    for (const PointSample& point : set.reflectors) {
        sum +=
            static_cast<double>(point.share) * area_of(corners(scene, parts, point.surface, point.triangle));
    }
    EXPECT_NEAR(sum / parts.area_m2(), 1.0, 1e-5);
    const auto place = [&](const PointSample& point) {
        const std::array<glm::dvec3, 3> c = corners(scene, parts, point.surface, point.triangle);
        return c[0] + (c[1] - c[0]) * static_cast<double>(point.second) +
               (c[2] - c[0]) * static_cast<double>(point.third);
    };
    // The j-th points of all runs lie near each other, against points of runs picked anywhere.
    double near = 0.0;
    double any = 0.0;
    for (size_t run = 1; run < 32; ++run) {
        for (size_t j = 0; j < 128; ++j) {
            const glm::dvec3 there = place(set.reflectors[run * 128 + j]);
            near += glm::distance(place(set.reflectors[j]), there);
            any += glm::distance(place(set.reflectors[(j + 41) % 128]), there);
        }
    }
    EXPECT_LT(near, 0.4 * any);
}

TEST(PointSet, RowsOfReflectorsArePatchesOfALargeTriangle) {
    const Scene scene = triangle_scene();
    const SurfaceParts parts = surface_parts(scene, k_all_animations);
    constexpr size_t rows = 128;
    constexpr size_t runs = 64;
    PointCounts counts;
    counts.reflectors_a_map = rows;
    counts.reflectors = rows * runs;
    const PointSet set = sample_points(parts, none_on_hull(parts), counts);
    ASSERT_EQ(set.reflectors.size(), counts.reflectors);
    // 128 = 2^7 halvings cut the right triangle of area 1/2 into ones of legs 1/8 and sides of sqrt(2)/8.
    const double widest = std::sqrt(2.0) / 8.0 + 1e-6;
    double mean_x = 0.0;
    for (size_t j = 0; j < rows; ++j) {
        glm::dvec2 low(1.0);
        glm::dvec2 high(0.0);
        for (size_t run = 0; run < runs; ++run) {
            const PointSample& point = set.reflectors[run * rows + j];
            const glm::dvec2 at(point.second, point.third);
            EXPECT_GE(std::min(at.x, at.y), 0.0);
            EXPECT_LE(at.x + at.y, 1.0 + 1e-6);
            low = glm::min(low, at);
            high = glm::max(high, at);
            mean_x += at.x / static_cast<double>(rows * runs);
        }
        EXPECT_LE(std::max(high.x - low.x, high.y - low.y), widest) << "row " << j;
        // Points of a row fill its patch, and do not lie on one another.
        EXPECT_GT(std::max(high.x - low.x, high.y - low.y), 0.5 / 8.0) << "row " << j;
    }
    EXPECT_NEAR(mean_x, 1.0 / 3.0, 2e-3) << "the triangle's centroid; random points would stray by 2.6e-3";
}

TEST(PointSet, ReflectorsFollowPlacesNotTheOrderOfNodes) {
    const auto reflectors = [](bool turned_round) {
        Scene scene;
        const int mesh = add_mesh(scene, square(1.0F));
        std::vector<glm::dvec3> at = {{0, 0, 0}, {3, 0, 1}, {6, 1, 0}, {1, 5, 2}};
        if (turned_round) {
            std::reverse(at.begin(), at.end());
        }
        for (const glm::dvec3& place : at) {
            place_mesh(scene, mesh, moved(place));
        }
        const SurfaceParts parts = surface_parts(scene, k_all_animations);
        PointCounts counts;
        counts.reflectors_a_map = 64;
        counts.reflectors = 256;
        std::vector<glm::dvec3> out;
        for (const PointSample& point :
             sample_points(parts, std::vector<bool>(parts.parts.size(), false), counts).reflectors) {
            const PointSurface& surface = parts.surfaces[point.surface];
            out.emplace_back(at[static_cast<size_t>(surface.node)].x, point.second, point.third);
        }
        return out;
    };
    EXPECT_EQ(reflectors(false), reflectors(true));
}

TEST(PointSet, ReflectorsStayOnThePrimitivesOwnTriangles) {
    Scene scene;
    place_mesh(scene, add_mesh(scene, refine(square(2.0F), refinement_by(25.0))));
    const SurfaceParts parts = surface_parts(scene, k_all_animations);
    PointCounts counts = occluders(256, 64, false);
    counts.reflectors_a_map = 64;
    counts.reflectors = 256;
    const PointSet set = sample_points(parts, none_on_hull(parts), counts);
    std::set<std::array<uint32_t, 4>> own;
    for (const glm::uvec3& t : triangles_of(scene.meshes[0].primitives[0])) {
        own.insert(key(0, t));
    }
    std::set<std::array<uint32_t, 4>> occluding;
    for (const PointSample& point : set.reflectors) {
        ASSERT_TRUE(own.contains(key(0, point.triangle)));
    }
    for (const PointSample& point : set.occluders) {
        occluding.insert(key(0, point.triangle));
    }
    EXPECT_EQ(occluding.size(), 2U);
}

TEST(PointSet, ReflectorsAreThinnedFarFromABall) {
    // A square of side 200 around a ball of radius 1 in its middle, and a small one inside the ball.
    Scene scene;
    place_mesh(scene, add_mesh(scene, square(200.0F)), glm::dmat4(1.0));
    const int small = place_mesh(scene, add_mesh(scene, square(1.0F)), glm::dmat4(1.0));
    const SurfaceParts parts = surface_parts(scene, k_all_animations);
    Thinning thinning;
    thinning.radius = 1.0;
    thinning.scene = &scene;
    for (const PointSurface& surface : parts.surfaces) {
        thinning.surfaces.push_back(surface.node != small);
        thinning.world_from_model.emplace_back(1.0);
    }
    PointCounts counts;
    counts.reflectors_a_map = 256;
    counts.reflectors = 256 * 64;
    const PointSet set = sample_points(parts, none_on_hull(parts), counts, &thinning);
    ASSERT_EQ(set.reflectors.size(), counts.reflectors);
    double area = 0.0;  // that the points stand for
    double on_small = 0.0;
    double near = 0.0;  // of the large one within 10 of the middle
    int points_near = 0;
    for (const PointSample& point : set.reflectors) {
        const auto c = corners(scene, parts, point.surface, point.triangle);
        const double stands_for = static_cast<double>(point.share) * area_of(c);
        const glm::dvec3 at = c[0] + (c[1] - c[0]) * static_cast<double>(point.second) +
                              (c[2] - c[0]) * static_cast<double>(point.third);
        area += stands_for;
        if (parts.surfaces[point.surface].node == small) {
            on_small += stands_for;
            EXPECT_NEAR(stands_for / set.dense_reflector_area_m2, 1.0, 1e-4)
                << "dense where nothing is thinned";
        } else if (glm::length(at) < 10.0) {
            near += stands_for;
            ++points_near;
        }
        EXPECT_GE(stands_for, 0.999 * set.dense_reflector_area_m2);
    }
    // Each piece's points stand for its area up to the randomness of their number: most of the area is that
    // of a few points far off, hence 10 % and not 1 %.
    EXPECT_NEAR(area / 40001.0, 1.0, 0.1);
    EXPECT_NEAR(on_small, 1.0, 0.02);
    EXPECT_NEAR(near / (pi * 100.0), 1.0, 0.03);
    EXPECT_GT(points_near, 0.75 * static_cast<double>(counts.reflectors)) << "and not a hundredth of them";
    EXPECT_NEAR(set.reflector_area_m2, 40001.0, 1.0);
}

}  // namespace
}  // namespace bounce::scene::test
