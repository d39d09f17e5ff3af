// SPDX-License-Identifier: Apache-2.0
#include "scene/emissive_panels.h"

#include <gtest/gtest.h>

#include "point_samples.h"

namespace bounce::scene::test {
namespace {

// One shape that emits radiance 3.
Scene emitting(Primitive shape, const glm::dmat4& place = glm::dmat4(1.0)) {
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].emission = glm::vec3(1.0F);
    scene.materials[0].emission_strength = 3.0F;
    shape.material = 0;
    place_mesh(scene, add_mesh(scene, shape), place);
    place_mesh(scene, add_mesh(scene, square(1.0F)), moved({0.0, 0.0, -20.0}));  // something else to be lit
    return scene;
}

PanelPose lit(const Scene& scene, size_t most = 16) {
    return with_panel_lights(scene, evaluate_pose(scene, 0.0), find_emissive_panels(scene, most).panels, 0.0);
}

// n x n squares that make one of side 2.
Primitive grid(int n) {
    Primitive p;
    for (int y = 0; y <= n; ++y) {
        for (int x = 0; x <= n; ++x) {
            p.positions.emplace_back(2.0F * static_cast<float>(x) / static_cast<float>(n) - 1.0F,
                                     2.0F * static_cast<float>(y) / static_cast<float>(n) - 1.0F, 0.0F);
        }
    }
    const auto w = static_cast<uint32_t>(n + 1);
    for (uint32_t y = 0; y + 1 < w; ++y) {
        for (uint32_t x = 0; x + 1 < w; ++x) {
            const uint32_t i = y * w + x;
            p.indices.insert(p.indices.end(), {i, i + 1, i + w + 1, i, i + w + 1, i + w});
        }
    }
    return p;
}

TEST(EmissivePanels, ASheetIsTwoLightsOfItsRadiance) {
    for (const Primitive& shape : {square(2.0F), grid(5)}) {
        const Scene scene = emitting(shape, moved({1.0, 2.0, 3.0}));
        const EmissivePanels found = find_emissive_panels(scene, 2);
        EXPECT_TRUE(found.all);
        ASSERT_EQ(found.panels.size(), 1U);
        EXPECT_EQ(found.panels[0].triangles.size(), shape.indices.size() / 3);
        const PanelPose pose = with_panel_lights(scene, evaluate_pose(scene, 0.0), found.panels, 0.125);
        ASSERT_EQ(pose.pose.light_instances.size(), 2U);
        for (size_t i = 0; i < 2; ++i) {
            const Light& light = pose.pose.lights[i];
            EXPECT_EQ(light.type, LightType::area);
            EXPECT_NEAR(light.power_w, 4.0 * 4.0 * 3.0, 1e-4) << "L = P / (4 A)";
            EXPECT_NEAR(light.size_x_m * light.size_y_m, 4.0, 1e-5);
            const glm::dmat4& m = pose.pose.light_instances[i].world_from_light;
            const double side = i == 0 ? 1.0 : -1.0;
            EXPECT_NEAR(-m[2].z, side, 1e-9) << "along its -Z, from the side where triangles turn left first";
            EXPECT_NEAR(glm::length(glm::dvec3(m[3]) - glm::dvec3(1.0, 2.0, 3.0 + 0.125 * side)), 0.0, 1e-6);
            EXPECT_NEAR(glm::determinant(m), 1.0, 1e-9);
        }
    }
}

TEST(EmissivePanels, ABodyHasOneLightAFaceAndTheLargestComeFirst) {
    const Scene scene = emitting(box({1.0F, 2.0F, 0.1F}));
    EXPECT_EQ(lit(scene).pose.lights.size(), 6U);
    const EmissivePanels two = find_emissive_panels(scene, 3);
    EXPECT_FALSE(two.all);
    const PanelPose pose = with_panel_lights(scene, evaluate_pose(scene, 0.0), two.panels, 0.0);
    ASSERT_EQ(pose.pose.lights.size(), 3U);
    EXPECT_NEAR(pose.pose.lights[0].power_w, 4.0 * 3.0 * 8.0, 1e-3);
    EXPECT_NEAR(pose.pose.lights[1].power_w, 4.0 * 3.0 * 8.0, 1e-3);
    EXPECT_LT(glm::dot(glm::dvec3(pose.pose.light_instances[0].world_from_light[2]),
                       glm::dvec3(pose.pose.light_instances[1].world_from_light[2])),
              -0.99);
}

TEST(EmissivePanels, WhatIsNoEvenRectangleIsNone) {
    Scene triangle = emitting(square(1.0F));
    triangle.meshes[0].primitives[0].indices.resize(3);
    EXPECT_TRUE(find_emissive_panels(triangle, 16).panels.empty());
    EXPECT_FALSE(find_emissive_panels(triangle, 16).all);

    Scene bent = emitting(grid(2));
    bent.meshes[0].primitives[0].positions[4].z = 0.1F;
    EXPECT_TRUE(find_emissive_panels(bent, 16).panels.empty());

    Scene textured = emitting(square(1.0F));
    textured.materials[0].emission_texture.texture = 0;
    textured.textures.resize(1);
    EXPECT_TRUE(find_emissive_panels(textured, 16).panels.empty());

    Scene dark = emitting(square(1.0F));
    dark.materials[0].emission_strength = 0.0F;
    EXPECT_TRUE(find_emissive_panels(dark, 16).panels.empty());

    Scene unlit = emitting(square(1.0F));
    unlit.materials[0].unlit = true;
    EXPECT_TRUE(find_emissive_panels(unlit, 16).panels.empty());

    Scene morphing = emitting(square(1.0F));
    morphing.meshes[0].primitives[0].targets.resize(1);
    EXPECT_TRUE(find_emissive_panels(morphing, 16).panels.empty());
    EXPECT_TRUE(find_emissive_panels(emitting(square(1.0F)), 0).panels.empty());
}

TEST(EmissivePanels, ASkewedOneIsLeftToPoints) {
    glm::dmat4 skew(1.0);
    skew[1].x = 0.5;
    const PanelPose pose = lit(emitting(square(1.0F), skew));
    EXPECT_TRUE(pose.lit.empty());
    EXPECT_TRUE(pose.pose.lights.empty());
    glm::dmat4 stretched(1.0);
    stretched[0].x = 3.0;
    ASSERT_EQ(lit(emitting(square(1.0F), stretched)).pose.lights.size(), 2U);
    EXPECT_NEAR(lit(emitting(square(1.0F), stretched)).pose.lights[0].power_w, 4.0 * 3.0 * 3.0, 1e-4);
}

TEST(EmissivePanels, AMirroredBodyStillShinesOutwards) {
    glm::dmat4 mirror(1.0);
    mirror[2].z = -1.0;
    const PanelPose pose = lit(emitting(box({1.0F, 1.0F, 1.0F}), mirror));
    ASSERT_EQ(pose.pose.light_instances.size(), 6U);
    for (const LightInstance& light : pose.pose.light_instances) {
        const glm::dvec3 place(light.world_from_light[3]);
        EXPECT_GT(glm::dot(-glm::dvec3(light.world_from_light[2]), place), 0.9);
    }
}

TEST(EmissivePanels, ABodyAroundSomethingShinesInwardsToo) {
    Scene scene = emitting(box({3.0F, 3.0F, 3.0F}));
    EXPECT_EQ(lit(scene).pose.lights.size(), 6U);
    place_mesh(scene, add_mesh(scene, square(0.5F)), moved({0.0, 0.0, 1.0}));
    EXPECT_EQ(lit(scene).pose.lights.size(), 12U);
}

TEST(EmissivePanels, ABodyTurnedInsideOutShinesOutwards) {
    Primitive shape = box({1.0F, 1.0F, 1.0F});
    for (size_t i = 0; i + 2 < shape.indices.size(); i += 3) {
        std::swap(shape.indices[i + 1], shape.indices[i + 2]);
    }
    const PanelPose pose = lit(emitting(shape));
    ASSERT_EQ(pose.pose.light_instances.size(), 6U);
    for (const LightInstance& light : pose.pose.light_instances) {
        EXPECT_GT(glm::dot(-glm::dvec3(light.world_from_light[2]), glm::dvec3(light.world_from_light[3])),
                  0.9);
    }
}

TEST(EmissivePanels, VerticesThatRoundingPartedAreOne) {
    // A closed box whose corners differ by a millionth of its side from face to face.
    Primitive shape = box({1.0F, 1.0F, 1.0F});
    for (size_t i = 0; i < shape.positions.size(); ++i) {
        shape.positions[i].x += 1e-6F * static_cast<float>(i % 3);
    }
    EXPECT_EQ(lit(emitting(shape)).pose.lights.size(), 6U);
}

TEST(EmissivePanels, OneThatIsHiddenOrDarkIsNoLight) {
    Scene scene = emitting(square(1.0F));
    Pose pose = evaluate_pose(scene, 0.0);
    const EmissivePanels found = find_emissive_panels(scene, 16);
    pose.materials[0].emission = glm::vec3(0.0F);
    EXPECT_TRUE(with_panel_lights(scene, pose, found.panels, 0.0).pose.lights.empty());
    pose = evaluate_pose(scene, 0.0);
    pose.draws.clear();
    EXPECT_TRUE(with_panel_lights(scene, pose, found.panels, 0.0).pose.lights.empty());
}

}  // namespace
}  // namespace bounce::scene::test
