// SPDX-License-Identifier: Apache-2.0
//
// Points that occlude: as many as their areas say, evenly, and together with the triangles that are drawn
// whole all of the area.
#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "point_samples.h"
#include "scene/refine.h"

namespace bounce::scene::test {
namespace {

TEST(PointSet, AsManyAsAreaSays) {
    const Scene scene = mixed_scene();
    const SurfaceParts parts = surface_parts(scene, k_all_animations);
    constexpr size_t count = 1 << 14;
    const PointSet set = sample_points(parts, none_on_hull(parts), occluders(count, 1024, false));
    ASSERT_EQ(set.occluders.size(), count);
    EXPECT_TRUE(set.large.empty());
    EXPECT_TRUE(set.reflectors.empty());
    std::map<std::array<uint32_t, 4>, size_t> found;
    for (const PointSample& point : set.occluders) {
        ++found[key(point.surface, point.triangle)];
    }
    double total = 0.0;
    for (uint32_t s = 0; s < parts.surfaces.size(); ++s) {
        for (const glm::uvec3& t : triangles_of(primitive_of(scene, parts, s))) {
            total += area_of(corners(scene, parts, s, t));
        }
    }
    EXPECT_NEAR(set.occluder_area_m2 / total, 1.0, 1e-6);
    for (uint32_t s = 0; s < parts.surfaces.size(); ++s) {
        for (const glm::uvec3& t : triangles_of(primitive_of(scene, parts, s))) {
            const double expected = static_cast<double>(count) * area_of(corners(scene, parts, s, t)) / total;
            // A run of strata of one point each: off by one at both of its ends.
            EXPECT_NEAR(static_cast<double>(found[key(s, t)]), expected, 2.0) << s << ' ' << t.x;
        }
    }
}

TEST(PointSet, SharesAddUpToTheArea) {
    const Scene scene = mixed_scene();
    const SurfaceParts parts = surface_parts(scene, k_all_animations);
    for (const bool large : {false, true}) {
        for (const size_t count : {size_t{1}, size_t{7}, size_t{1000}, size_t{4096}}) {
            const PointSet set = sample_points(parts, none_on_hull(parts), occluders(count, 256, large));
            double sum = 0.0;
            for (const PointSample& point : set.occluders) {
                sum += static_cast<double>(point.share) *
                       area_of(corners(scene, parts, point.surface, point.triangle));
            }
            EXPECT_NEAR(sum / set.occluder_area_m2, 1.0, 1e-5) << count;
            double whole = 0.0;
            for (const SurfaceTriangle& triangle : set.large) {
                whole += area_of(corners(scene, parts, triangle.surface, triangle.triangle));
            }
            EXPECT_NEAR((whole + set.occluder_area_m2) / parts.area_m2(), 1.0, 1e-6)
                << "points and large triangles together are all there is";
            EXPECT_EQ(set.large.empty(), !large);
        }
    }
}

TEST(PointSet, EvenWithinATriangle) {
    const Scene scene = triangle_scene();
    const SurfaceParts parts = surface_parts(scene, k_all_animations);
    constexpr size_t count = 4096;
    const PointSet set = sample_points(parts, none_on_hull(parts), occluders(count, 64, false));
    // Cut into 64 triangles of the same area, by an 8 x 8 grid of barycentric coordinates.
    std::map<std::array<int, 3>, int> cells;
    for (const PointSample& point : set.occluders) {
        EXPECT_GE(point.second, 0.0F);
        EXPECT_GE(point.third, 0.0F);
        EXPECT_LE(point.second + point.third, 1.0F + 1e-6F);
        const double a = 8.0 * static_cast<double>(point.second);
        const double b = 8.0 * static_cast<double>(point.third);
        ++cells[{static_cast<int>(a), static_cast<int>(b),
                 a - std::floor(a) + b - std::floor(b) < 1.0 ? 0 : 1}];
    }
    EXPECT_EQ(cells.size(), 64U);
    for (const auto& [cell, found] : cells) {
        // 64 expected; random points would stray by 8 in one of three cells and by 20 in one of a hundred.
        EXPECT_NEAR(found, 64, 14) << cell[0] << ' ' << cell[1] << ' ' << cell[2];
    }
}

// Variance of the number of points that runs of a length have on a surface of a third of the area, over that
// of random points, length * 1/3 * 2/3.
double variance_of_runs(const std::vector<PointSample>& points, size_t length, uint32_t surface) {
    double sum = 0.0;
    double squares = 0.0;
    double runs = 0.0;
    for (size_t first = 0; first + length <= points.size(); first += length) {
        const auto begin = points.begin() + static_cast<std::ptrdiff_t>(first);
        const auto on = static_cast<double>(
            std::count_if(begin, begin + static_cast<std::ptrdiff_t>(length),
                          [&](const PointSample& point) { return point.surface == surface; }));
        sum += on;
        squares += on * on;
        runs += 1.0;
    }
    return (squares - sum * sum / runs) / (runs - 1.0) / (static_cast<double>(length) * 2.0 / 9.0);
}

TEST(PointSet, RunsAreStratified) {
    Scene scene;
    const int mesh = add_mesh(scene, square(1.0F));
    place_mesh(scene, mesh);
    place_mesh(scene, mesh, moved({5.0, 0.0, 1.0}) * scaled(glm::dvec3(std::sqrt(2.0))));
    const SurfaceParts parts = surface_parts(scene, k_all_animations);
    const PointSet set = sample_points(parts, none_on_hull(parts), occluders(1 << 16, 512, false));
    EXPECT_LT(variance_of_runs(set.occluders, 512, 0), 0.01) << "a power of two: within one point";
    // Any other length is a few powers of two.
    for (const size_t length : {size_t{300}, size_t{805}, size_t{1000}}) {
        EXPECT_LT(variance_of_runs(set.occluders, length, 0), 0.05) << length;
    }
}

TEST(PointSet, FlatPointsLieOnPlanes) {
    Scene scene;
    const int soup = place_mesh(scene, add_mesh(scene, triangle_soup(300, 2)));
    const int wall = place_mesh(scene, add_mesh(scene, square(4.0F)));
    const SurfaceParts parts = surface_parts(scene, k_all_animations);
    const PointSet set = sample_points(parts, none_on_hull(parts), occluders(4096, 4096, false));
    int flat = 0;
    for (const PointSample& point : set.occluders) {
        const int node = parts.surfaces[point.surface].node;
        if (node == wall) {
            EXPECT_TRUE(point.flat);
            ++flat;
        }
        if (node == soup && point.flat) {
            // Only where the triangle alone is large enough to be a plane of its own.
            EXPECT_GT(area_of(corners(scene, parts, point.surface, point.triangle)), 0.002 * parts.area_m2());
        }
    }
    EXPECT_GT(flat, 1000);
}

TEST(PointSet, PointsOnTheHullAreLeftOut) {
    const Scene scene = mixed_scene();
    const SurfaceParts parts = surface_parts(scene, k_all_animations);
    std::vector<bool> on_hull(parts.parts.size(), false);
    std::map<uint32_t, double> kept;
    for (size_t i = 0; i < on_hull.size(); ++i) {
        on_hull[i] = parts.parts[i].surface % 2 == 1;
        if (!on_hull[i]) {
            kept[parts.parts[i].surface] += parts.parts[i].area_m2;
        }
    }
    const PointSet set = sample_points(parts, on_hull, occluders(2048, 64, true));
    double area = 0.0;
    for (const auto& [surface, part] : kept) {
        area += part;
    }
    for (const PointSample& point : set.occluders) {
        ASSERT_EQ(point.surface % 2, 0U);
    }
    for (const SurfaceTriangle& triangle : set.large) {
        ASSERT_EQ(triangle.surface % 2, 0U);
        area -= area_of(corners(scene, parts, triangle.surface, triangle.triangle));
    }
    EXPECT_NEAR(set.occluder_area_m2 / area, 1.0, 1e-6);
}

// Triangles by falling area, each taken while it would have six points of a map where the points are spread
// over what is left; and none that would not have a sixteenth of that where they are spread over everything.
size_t expected_large(const Scene& scene, const SurfaceParts& parts, double points) {
    std::vector<double> areas;
    for (uint32_t s = 0; s < parts.surfaces.size(); ++s) {
        for (const glm::uvec3& t : triangles_of(primitive_of(scene, parts, s))) {
            areas.push_back(area_of(corners(scene, parts, s, t)));
        }
    }
    std::sort(areas.begin(), areas.end(), std::greater<>());
    double left = 0.0;
    for (const double area : areas) {
        left += area;
    }
    const double least = 6.0 * left / points / 16.0;
    size_t count = 0;
    while (count < std::min(areas.size(), k_most_large_triangles) &&
           areas[count] >= std::max(6.0 * left / points, least)) {
        left -= areas[count++];
    }
    return count;
}

TEST(PointSet, LargeTrianglesAreTheLargest) {
    for (const bool boxes : {false, true}) {
        Scene scene = mixed_scene();
        if (boxes) {
            for (int i = 0; i < 10; ++i) {  // 120 triangles of a size: more than may be drawn whole
                place_mesh(scene, 1, moved({0.0, 0.0, 3.0 + i}));
            }
        }
        const SurfaceParts parts = surface_parts(scene, k_all_animations);
        for (const size_t a_map : {size_t{64}, size_t{512}, size_t{4096}}) {
            const PointSet set = sample_points(parts, none_on_hull(parts), occluders(4096, a_map, true));
            EXPECT_EQ(set.large.size(), expected_large(scene, parts, static_cast<double>(a_map))) << a_map;
            double least = 1e300;
            std::map<std::array<uint32_t, 4>, int> taken;
            for (const SurfaceTriangle& triangle : set.large) {
                least = std::min(least, area_of(corners(scene, parts, triangle.surface, triangle.triangle)));
                ++taken[key(triangle.surface, triangle.triangle)];
            }
            EXPECT_EQ(taken.size(), set.large.size()) << "none twice";
            for (const PointSample& point : set.occluders) {
                ASSERT_EQ(taken.count(key(point.surface, point.triangle)), 0U)
                    << "no points on what is drawn whole";
                ASSERT_LE(area_of(corners(scene, parts, point.surface, point.triangle)),
                          least * (1.0 + 1e-6));
            }
        }
    }
}

TEST(PointSet, LargeTrianglesMayBeAllThereIs) {
    Scene scene;
    place_mesh(scene, add_mesh(scene, box(glm::vec3(1.0F))));
    const SurfaceParts parts = surface_parts(scene, k_all_animations);
    const PointSet set = sample_points(parts, none_on_hull(parts), occluders(4096, 512, true));
    EXPECT_EQ(set.large.size(), 12U);
    EXPECT_TRUE(set.occluders.empty());
    EXPECT_EQ(set.occluder_area_m2, 0.0);
}

// Corners of a set's large triangles, in any order.
std::multiset<std::array<float, 3>> large_corners(const Scene& scene, const SurfaceParts& parts,
                                                  const PointSet& set) {
    std::multiset<std::array<float, 3>> out;
    for (const SurfaceTriangle& triangle : set.large) {
        for (int k = 0; k < 3; ++k) {
            const glm::vec3& p = primitive_of(scene, parts, triangle.surface).positions[triangle.triangle[k]];
            out.insert({p.x, p.y, p.z});
        }
    }
    return out;
}

TEST(PointSet, FinelyCutWallsAreDrawnWholeAllTheSame) {
    Scene scene;
    const Primitive crate = box({0.5F, 0.3F, 0.2F});
    place_mesh(scene, add_mesh(scene, crate), turned(0.5));
    place_mesh(scene, add_mesh(scene, triangle_soup(4000, 3)), scaled(glm::dvec3(0.2)));
    const SurfaceParts parts = surface_parts(scene, k_all_animations);
    const PointSet set = sample_points(parts, none_on_hull(parts), occluders(4096, 512, true));
    ASSERT_EQ(set.large.size(), 12U);
    const std::multiset<std::array<float, 3>> expected = large_corners(scene, parts, set);
    const std::set<std::array<float, 3>> expected_places(expected.begin(), expected.end());
    for (const double factor : {4.0, 10.0, 100.0}) {
        scene.meshes[0].primitives[0] = refine(crate, refinement_by(factor));
        const SurfaceParts fine_parts = surface_parts(scene, k_all_animations);
        const PointSet fine = sample_points(fine_parts, none_on_hull(fine_parts), occluders(4096, 512, true));
        EXPECT_EQ(fine.large.size(), 12U) << factor;
        const std::multiset<std::array<float, 3>> found = large_corners(scene, fine_parts, fine);
        EXPECT_EQ(std::set(found.begin(), found.end()), expected_places);
        EXPECT_NEAR(fine.occluder_area_m2 / set.occluder_area_m2, 1.0, 1e-6);
        for (const PointSample& point : fine.occluders) {
            ASSERT_NE(fine_parts.surfaces[point.surface].node, 0) << "no points on what is drawn whole";
        }
    }
}

TEST(PointSet, CutOutsAreNeverDrawnWhole) {
    Scene scene;
    Primitive p = square(4.0F);
    p.material = 0;
    scene.materials.resize(1);
    scene.materials[0].alpha_mode = AlphaMode::mask;
    place_mesh(scene, add_mesh(scene, p));
    const SurfaceParts parts = surface_parts(scene, k_all_animations);
    const PointSet set = sample_points(parts, none_on_hull(parts), occluders(256, 256, true));
    EXPECT_TRUE(set.large.empty());
    EXPECT_EQ(set.occluders.size(), 256U);
    scene.meshes[0].primitives[0] = refine(p, refinement_by(16.0));
    const SurfaceParts fine = surface_parts(scene, k_all_animations);
    EXPECT_EQ(fine.parts[0].cover, fine.parts[0].table) << "its points ask textures of their own triangles";
    EXPECT_TRUE(sample_points(fine, none_on_hull(fine), occluders(256, 256, true)).large.empty());
}

TEST(PointSet, SameInputSamePoints) {
    const Scene scene = mixed_scene();
    PointCounts counts = occluders(1000, 100, true);
    counts.reflectors = 500;
    counts.reflectors_a_map = 50;
    const SurfaceParts a = surface_parts(scene, k_all_animations);
    const SurfaceParts b = surface_parts(scene, k_all_animations);
    const PointSet first = sample_points(a, none_on_hull(a), counts);
    const PointSet second = sample_points(b, none_on_hull(b), counts);
    const auto same = [](const PointSample& x, const PointSample& y) {
        return x.surface == y.surface && x.triangle == y.triangle && x.second == y.second &&
               x.third == y.third && x.share == y.share && x.flat == y.flat;
    };
    EXPECT_TRUE(std::equal(first.occluders.begin(), first.occluders.end(), second.occluders.begin(),
                           second.occluders.end(), same));
    EXPECT_TRUE(std::equal(first.reflectors.begin(), first.reflectors.end(), second.reflectors.begin(),
                           second.reflectors.end(), same));
    EXPECT_TRUE(std::equal(first.large.begin(), first.large.end(), second.large.begin(), second.large.end(),
                           [](const SurfaceTriangle& x, const SurfaceTriangle& y) {
                               return x.surface == y.surface && x.triangle == y.triangle;
                           }));
}

TEST(PointSet, OfNothingIsEmpty) {
    PointCounts counts = occluders(100, 10, true);
    counts.reflectors = 100;
    counts.reflectors_a_map = 10;
    const PointSet empty = sample_points({}, {}, counts);
    EXPECT_TRUE(empty.occluders.empty() && empty.reflectors.empty() && empty.large.empty());
    EXPECT_EQ(empty.occluder_area_m2 + empty.reflector_area_m2, 0.0);
    Scene scene;
    place_mesh(scene, add_mesh(scene, square(1.0F)));
    const SurfaceParts parts = surface_parts(scene, k_all_animations);
    const PointSet hull = sample_points(parts, {true}, counts);
    EXPECT_TRUE(hull.occluders.empty() && hull.large.empty());
    EXPECT_EQ(hull.reflectors.size(), 100U);
    const PointSet none = sample_points(parts, {false}, {});
    EXPECT_TRUE(none.occluders.empty() && none.reflectors.empty() && none.large.empty());
}

}  // namespace
}  // namespace bounce::scene::test
