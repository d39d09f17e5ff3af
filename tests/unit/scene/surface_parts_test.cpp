// SPDX-License-Identifier: Apache-2.0
//
// Areas of a scene's parts, against areas summed up triangle by triangle.
#include "scene/points/surface_parts.h"

#include <algorithm>
#include <limits>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "made_scenes.h"
#include "scene/points/deformed_positions.h"
#include "scene/refine.h"

namespace bounce::scene::test {
namespace {

// Each part's triangles hold the part's area, in the proportions the table says.
void expect_parts_hold_together(const SurfaceParts& parts) {
    for (const SurfacePart& part : parts.parts) {
        ASSERT_LT(part.surface, parts.surfaces.size());
        ASSERT_EQ(part.table->triangles.size(), part.table->cumulative.size());
        double before = 0.0;
        for (const double sum : part.table->cumulative) {
            EXPECT_GE(sum, before);
            before = sum;
        }
        EXPECT_GT(part.area_m2, 0.0);
    }
}

TEST(SurfaceParts, OfASquare) {
    Scene scene;
    place_mesh(scene, add_mesh(scene, square(3.0F)));
    const SurfaceParts parts = surface_parts(scene, k_all_animations);
    ASSERT_EQ(parts.surfaces.size(), 1U);
    ASSERT_EQ(parts.parts.size(), 1U) << "two triangles of one plane";
    EXPECT_NEAR(parts.area_m2(), 9.0, 1e-9);
    EXPECT_TRUE(parts.parts[0].table->flat);
    EXPECT_NEAR(std::abs(parts.parts[0].table->normal.z), 1.0, 1e-9);
    EXPECT_NEAR(parts.parts[0].table->point.z, 0.0, 1e-9);
    EXPECT_FALSE(parts.surfaces[0].deforms);
}

TEST(SurfaceParts, EachFaceOfABoxIsAPart) {
    Scene scene;
    place_mesh(scene, add_mesh(scene, box({0.5F, 1.0F, 2.0F})), moved({1e4, -3.0, 0.5}));
    const SurfaceParts parts = surface_parts(scene, k_all_animations);
    ASSERT_EQ(parts.parts.size(), 6U);
    EXPECT_NEAR(parts.area_m2(), 2.0 * (1.0 * 2.0 + 2.0 * 4.0 + 4.0 * 1.0), 1e-5);
    for (const SurfacePart& part : parts.parts) {
        EXPECT_TRUE(part.table->flat);
        EXPECT_EQ(part.table->triangles.size(), 2U);
    }
}

TEST(SurfaceParts, SmallFacetsAreNoPlanesOfTheirOwn) {
    // A tiny box beside a large floor: less than a five-hundredth of the area.
    Scene scene;
    place_mesh(scene, add_mesh(scene, square(10.0F)));
    place_mesh(scene, add_mesh(scene, box(glm::vec3(0.05F))));
    const SurfaceParts parts = surface_parts(scene, k_all_animations);
    ASSERT_EQ(parts.parts.size(), 2U);
    EXPECT_NEAR(parts.area_m2(), 100.06, 1e-5);
    EXPECT_FALSE(parts.parts[1].table->flat);
}

TEST(SurfaceParts, InstancesCountWithTheirOwnScale) {
    const Primitive soup = triangle_soup(50, 3);
    Scene scene;
    const int node = place_mesh(scene, add_mesh(scene, soup),
                                moved({1.0, 2.0, 3.0}) * turned(0.7) * scaled(glm::dvec3(2.0)));
    scene.nodes[0].instances = {moved({1.0, 0.0, 0.0}), turned(1.0) * scaled(glm::dvec3(0.5)),
                                scaled({1.0, 2.0, 0.3})};
    const SurfaceParts parts = surface_parts(scene, k_all_animations);
    ASSERT_EQ(parts.surfaces.size(), 3U);
    std::vector<double> areas(3, 0.0);
    for (const SurfacePart& part : parts.parts) {
        areas[part.surface] += part.area_m2;
    }
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(parts.surfaces[i].node, node);
        EXPECT_EQ(parts.surfaces[i].instance, static_cast<int>(i));
        // Scales within 1 % count as alike, and the mean of three roots is exact there to far below that.
        EXPECT_NEAR(areas[i] / area_under(soup, *scene.nodes[0].matrix * scene.nodes[0].instances[i]), 1.0,
                    1e-6)
            << i;
    }
    expect_parts_hold_together(parts);
}

TEST(SurfaceParts, PlacesOfOneMeshShareItsTable) {
    Scene scene;
    const int mesh = add_mesh(scene, triangle_soup(50, 4));
    place_mesh(scene, mesh);
    place_mesh(scene, mesh, turned(1.0) * scaled(glm::dvec3(3.0)));
    const SurfaceParts parts = surface_parts(scene, k_all_animations);
    std::map<const AreaTable*, std::vector<double>> areas;
    for (const SurfacePart& part : parts.parts) {
        areas[part.table.get()].push_back(part.area_m2);
    }
    EXPECT_EQ(areas.size(), parts.parts.size() / 2);
    for (const auto& [table, pair] : areas) {
        ASSERT_EQ(pair.size(), 2U);
        EXPECT_NEAR(std::max(pair[0], pair[1]) / std::min(pair[0], pair[1]), 9.0, 1e-9);
    }
}

TEST(SurfaceParts, UnderAnyTransform) {
    const Primitive soup = triangle_soup(80, 5);
    glm::dmat4 shear(1.0);
    shear[1] = {std::cos(1.0), std::sin(1.0), 0.0, 0.0};  // axes of one length, 57 degrees apart
    const glm::dmat4 mirrored = scaled({-1.0, 1.0, 1.0});
    for (const glm::dmat4& m :
         {scaled({1.0, 1.0, 1e-3}), scaled({5.0, 0.2, 1.0}) * turned(0.4), shear, turned(2.0) * shear,
          mirrored, scaled(glm::dvec3(1e-4)), scaled(glm::dvec3(1e5)), scaled({2.0, 0.0, 1.0})}) {
        Scene scene;
        place_mesh(scene, add_mesh(scene, soup), m);
        const SurfaceParts parts = surface_parts(scene, k_all_animations);
        EXPECT_NEAR(parts.area_m2() / area_under(soup, m), 1.0, 1e-5);
        expect_parts_hold_together(parts);
    }
}

TEST(SurfaceParts, TrianglesWithoutAreaAreLeftOut) {
    Scene scene;
    Primitive p = triangle_soup(40, 6);
    const double area = area_under(p, glm::dmat4(1.0));
    p.positions.push_back(p.positions[0]);
    p.indices.insert(p.indices.end(),
                     {0, 0, 1, 2, 0, static_cast<uint32_t>(p.positions.size()) - 1, 3, 3, 3});
    place_mesh(scene, add_mesh(scene, p));
    const SurfaceParts parts = surface_parts(scene, k_all_animations);
    EXPECT_NEAR(parts.area_m2() / area, 1.0, 1e-6);
    size_t triangles = 0;
    for (const SurfacePart& part : parts.parts) {
        for (const glm::uvec3& triangle : part.table->triangles) {
            EXPECT_LT(triangle.x, 120U);
            EXPECT_EQ(triangle, triangle.x + glm::uvec3(0, 1, 2)) << "not one of those added";
        }
        triangles += part.table->triangles.size();
    }
    EXPECT_EQ(triangles, 40U);
}

TEST(SurfaceParts, FinelyCutPlanesHaveACover) {
    Scene scene;
    const int mesh = add_mesh(scene, refine(square(2.0F), refinement_by(49.0)));
    place_mesh(scene, mesh, turned(0.3));
    place_mesh(scene, mesh, scaled({3.0, 1.0, 2.0}) * turned(0.8));
    const SurfaceParts parts = surface_parts(scene, k_all_animations);
    ASSERT_EQ(parts.parts.size(), 2U);
    for (const SurfacePart& part : parts.parts) {
        EXPECT_EQ(part.table->triangles.size(), 98U);
        ASSERT_EQ(part.cover->triangles.size(), 2U);
        EXPECT_NEAR(part.cover->cumulative.back() / part.table->cumulative.back(), 1.0, 1e-6);
        EXPECT_TRUE(part.cover->flat);
        EXPECT_EQ(part.cover->normal, part.table->normal);
    }
    scene.meshes[0].primitives[0] = square(2.0F);
    const SurfaceParts plain = surface_parts(scene, k_all_animations);
    EXPECT_EQ(plain.parts[0].cover, plain.parts[0].table) << "nothing to take together";
}

TEST(SurfaceParts, SmallPlanesAreCoveredWithinTheRest) {
    Scene scene;
    place_mesh(scene, add_mesh(scene, square(30.0F)));
    // Of its faces one pair is a hundredth of the square, the others a thousandth.
    place_mesh(scene, add_mesh(scene, refine(box({0.15F, 1.5F, 1.5F}), refinement_by(100.0))));
    const SurfaceParts parts = surface_parts(scene, k_all_animations);
    ASSERT_EQ(parts.parts.size(), 4U) << "the square, two faces, the rest";
    const auto found = std::find_if(parts.parts.begin(), parts.parts.end(),
                                    [](const SurfacePart& part) { return !part.table->flat; });
    ASSERT_NE(found, parts.parts.end());
    const SurfacePart& rest = *found;
    EXPECT_EQ(rest.table->triangles.size(), 800U);
    EXPECT_EQ(rest.cover->triangles.size(), 8U);
    EXPECT_NEAR(rest.cover->cumulative.back() / rest.table->cumulative.back(), 1.0, 1e-6);
}

TEST(SurfaceParts, ScenesWithoutAreaHaveNoParts) {
    EXPECT_TRUE(surface_parts({}, k_all_animations).parts.empty());
    Scene scene;
    Primitive p = square(1.0F);
    p.indices = {0, 0, 1};
    place_mesh(scene, add_mesh(scene, p));
    place_mesh(scene, add_mesh(scene, square(1.0F)), scaled(glm::dvec3(0.0)));
    Primitive none;
    place_mesh(scene, add_mesh(scene, none));
    const SurfaceParts parts = surface_parts(scene, k_all_animations);
    EXPECT_TRUE(parts.parts.empty());
    EXPECT_EQ(parts.area_m2(), 0.0);
}

TEST(SurfaceParts, UnreachableNodesDoNotCount) {
    Scene scene;
    place_mesh(scene, add_mesh(scene, square(1.0F)));
    place_mesh(scene, 0);
    scene.topological_order.pop_back();
    EXPECT_NEAR(surface_parts(scene, k_all_animations).area_m2(), 1.0, 1e-9);
}

// A square whose right half hangs on a joint that is scaled; and morphed wider before.
Scene deforming_scene() {
    Scene scene;
    Primitive p = square(1.0F);
    MorphTarget wider;
    wider.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 0, 0}};
    p.targets = {wider};
    p.joints.assign(4, glm::u16vec4(0, 1, 0, 0));
    p.weights = {{1, 0, 0, 0}, {0.25F, 0.75F, 0, 0}, {0.25F, 0.75F, 0, 0}, {1, 0, 0, 0}};
    const int mesh = add_mesh(scene, p);
    const int node = place_mesh(scene, mesh, moved({50.0, 0.0, 0.0}));
    scene.nodes[static_cast<size_t>(node)].skin = 0;
    scene.nodes[static_cast<size_t>(node)].weights = {0.5F};
    Skin skin;
    Node a;
    Node b;
    b.matrix = moved({2.0, 0.0, 1.0}) * scaled(glm::dvec3(1.5));
    skin.joints = {add_node(scene, a), add_node(scene, b)};
    skin.joint_from_mesh.assign(2, glm::mat4(1.0F));
    scene.skins.push_back(skin);
    return scene;
}

TEST(SurfaceParts, SkinnedAndMorphedAsAtTheFirstFrame) {
    const Scene scene = deforming_scene();
    // By hand: right corners are morphed to (1, +-0.5, 0), then a quarter stays and three go to
    // (2 + 1.5 x, 1.5 y, 1).
    const auto right = [](double y) {
        return 0.25 * glm::dvec3(1.0, y, 0.0) + 0.75 * glm::dvec3(3.5, 1.5 * y, 1.0);
    };
    const glm::dvec3 c[4] = {{-0.5, -0.5, 0.0}, right(-0.5), right(0.5), {-0.5, 0.5, 0.0}};
    const double area = 0.5 * glm::length(glm::cross(c[1] - c[0], c[2] - c[0])) +
                        0.5 * glm::length(glm::cross(c[2] - c[0], c[3] - c[0]));
    const SurfaceParts parts = surface_parts(scene, k_all_animations);
    EXPECT_NEAR(parts.area_m2(), area, 1e-6);
    EXPECT_TRUE(parts.surfaces[0].deforms);
    for (const SurfacePart& part : parts.parts) {
        EXPECT_FALSE(part.table->flat) << "what deforms is not held to be a plane";
    }
    const std::vector<glm::dvec3> positions =
        deformed_positions(scene, evaluate_pose(scene, 0.0), parts.surfaces[0]);
    ASSERT_EQ(positions.size(), 4U);
    for (size_t v = 0; v < 4; ++v) {
        EXPECT_LT(glm::length(positions[v] - c[v]), 1e-6) << v;
    }
}

TEST(SurfaceParts, WhatGrowsCountsWithItsLargestArea) {
    // Scale 1 to 3 to 1 over four seconds at 1 frame a second: the middle one of five moments is the largest.
    Scene scene;
    Node node;
    node.mesh = add_mesh(scene, square(1.0F));
    add_node(scene, node);
    scene.frames = {1, 5, 1.0};
    Animation animation;
    animation.samplers.push_back({Interpolation::linear, 3, {0.0F, 2.0F, 4.0F}, {1, 1, 1, 3, 3, 3, 1, 1, 1}});
    animation.channels.push_back({Property::node_scale, 0, 0});
    animation.duration_s = 4.0F;
    scene.animations.push_back(animation);
    EXPECT_NEAR(surface_parts(scene, k_all_animations).area_m2(), 9.0, 1e-6);
    scene.frames = {1, 1, 1.0};
    EXPECT_NEAR(surface_parts(scene, k_all_animations).area_m2(), 1.0, 1e-6) << "a single frame";
}

TEST(SurfaceParts, CutOutsAreMarked) {
    Scene scene;
    Primitive p = square(1.0F);
    p.material = 0;
    scene.materials.resize(1);
    place_mesh(scene, add_mesh(scene, p));
    EXPECT_FALSE(surface_parts(scene, k_all_animations).parts[0].cut_out);
    for (const AlphaMode mode : {AlphaMode::mask, AlphaMode::blend}) {
        scene.materials[0].alpha_mode = mode;
        EXPECT_TRUE(surface_parts(scene, k_all_animations).parts[0].cut_out);
    }
}

}  // namespace
}  // namespace bounce::scene::test
