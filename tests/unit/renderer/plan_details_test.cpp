// SPDX-License-Identifier: Apache-2.0
//
// What shaders and passes are spared, and how many bounces count. No OpenGL.
#include "renderer/plan_details.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/memory_fit.h"
#include "renderer/settings_check.h"

namespace bounce {
namespace {

scene::Scene square(const scene::Material& material) {
    scene::Scene scene;
    scene.materials = {material};
    scene::Primitive primitive;
    primitive.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
    primitive.normals.assign(3, {0, 0, 1});
    primitive.indices = {0, 1, 2};
    primitive.material = 0;
    scene.meshes = {{"triangle", {primitive}, {}}};
    scene::Node node;
    node.mesh = 0;
    scene.nodes = {node};
    scene.roots = scene.topological_order = {0};
    return scene;
}

double bound(const scene::Material& material, bool glossy) {
    const scene::Scene scene = square(material);
    return albedo_bound(scene, scene::evaluate_pose(scene, 0.0), glossy);
}

TEST(AlbedoBound, IsTheLargestChannelAndWhatLobesReflect) {
    scene::Material material;
    material.base_color = {0.2F, 0.5F, 0.1F, 1.0F};
    material.specular = 0.5F;
    EXPECT_NEAR(bound(material, false), 0.5, 1e-6);
    EXPECT_NEAR(bound(material, true), 0.6, 1e-6);
    material.base_color = {3.0F, 0.0F, 0.0F, 1.0F};
    EXPECT_EQ(bound(material, true), 1.0);
    material.unlit = true;
    EXPECT_EQ(bound(material, true), 0.0) << "what is unlit reflects nothing";
    EXPECT_EQ(albedo_bound({}, {}, true), 0.0);
    scene::Material dark;
    dark.base_color = glm::vec4(0.01F, 0.01F, 0.01F, 1.0F);
    scene::Scene bright = square(dark);
    bright.meshes[0].primitives[0].colors.assign(3, glm::vec4(50.0F));
    EXPECT_EQ(albedo_bound(bright, scene::evaluate_pose(bright, 0.0), false), 1.0)
        << "colours of vertices may be above 1";
}

TEST(CountedBounces, AreThoseBeforeTheRestIsTooLittle) {
    EXPECT_EQ(counted_bounces(3, 0.5), 3);
    EXPECT_EQ(counted_bounces(3, 0.02), 1) << "the second and the third have 4.1e-4";
    EXPECT_EQ(counted_bounces(3, 0.05), 2);
    EXPECT_EQ(counted_bounces(4, 0.2), 4);
    EXPECT_EQ(counted_bounces(4, 0.0), 0);
    EXPECT_EQ(counted_bounces(2, 5e-4), 0);
    EXPECT_EQ(counted_bounces(0, 0.5), 0);
    for (const double albedo : {0.001, 0.01, 0.03, 0.1, 0.3}) {
        const int counted = counted_bounces(4, albedo);
        double left_out = 0.0;
        for (int bounce = counted + 1; bounce <= 4; ++bounce) {
            left_out += std::pow(albedo, bounce);
        }
        EXPECT_LT(left_out, k_least_bounced_share) << albedo;
        EXPECT_GE(left_out + std::pow(albedo, counted), counted > 0 ? k_least_bounced_share : 0.0) << albedo;
    }
}

TEST(AbsentDetails, NameEveryBranchThatIsCompiledOut) {
    const scene::Scene scene = square({});
    const scene::Pose pose = scene::evaluate_pose(scene, 0.0);
    const Settings settings;
    const std::vector<LeftOut> absent =
        absent_details(scene, pose, settings, plan_frame(scene, pose, settings));
    std::vector<std::string> names;
    for (const LeftOut& item : absent) {
        names.push_back(item.pass);
        EXPECT_FALSE(item.reason.empty());
    }
    EXPECT_THAT(names,
                testing::IsSupersetOf({"base colour textures", "metallic-roughness textures", "normal maps",
                                       "emission textures", "vertex colours", "alpha test", "point lights",
                                       "spot lights", "suns", "area lights", "debug layers"}));
}

TEST(AbsentDetails, AreNotNamedWhereTheyAreThere) {
    scene::Material material;
    material.base_color_texture.texture = 0;
    material.alpha_mode = scene::AlphaMode::mask;
    scene::Scene scene = square(material);
    scene.textures.emplace_back();
    scene.meshes[0].primitives[0].colors.assign(3, glm::vec4(1.0F));
    const scene::Pose pose = scene::evaluate_pose(scene, 0.0);
    for (const LeftOut& item : absent_details(scene, pose, {}, plan_frame(scene, pose, {}))) {
        EXPECT_NE(item.pass, "base colour textures");
        EXPECT_NE(item.pass, "alpha test");
        EXPECT_NE(item.pass, "vertex colours");
    }
}

TEST(GiveUp, EveryStepEndsAndLeavesSettingsThatAreAllowed) {
    Settings settings;
    settings.bounces = 3;
    bool keeps = true;
    int sentences = 0;
    for (size_t step = 0; step < give_up_steps(); ++step) {
        while (!give_up(step, settings, keeps).empty()) {
            ASSERT_LT(++sentences, 100);
        }
    }
    EXPECT_FALSE(keeps);
    EXPECT_FALSE(settings.antialias);
    EXPECT_EQ(settings.ism_size, 32);
    EXPECT_EQ(settings.vpls, 64);
    EXPECT_EQ(settings.shadow_size, 256);
    EXPECT_EQ(settings_refusal(settings), "");
}

}  // namespace
}  // namespace bounce
