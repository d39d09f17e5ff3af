// SPDX-License-Identifier: Apache-2.0
#include "renderer/light_history.h"

#include <gtest/gtest.h>

namespace bounce {
namespace {

struct Scene {
    scene::Scene scene;
    scene::Pose pose;
    Scene() {
        scene::Primitive primitive;
        primitive.material = 0;
        scene.meshes.push_back({"mesh", {primitive}, {}});
        scene.materials.emplace_back();
        pose.materials = scene.materials;
        pose.lights.emplace_back();
        pose.lights[0].power_w = 10.0F;
        pose.light_instances.push_back({0, 0, glm::dmat4(1.0)});
        pose.draws.push_back({1, 0, scene::k_none, glm::dmat4(1.0)});
    }
};

TEST(LightChanged, SaysWhatChangesLightEverywhere) {
    const Scene s;
    EXPECT_EQ(light_changed(s.scene, s.pose, s.pose), "");
    scene::Pose now = s.pose;
    now.lights[0].power_w *= 1.001F;
    EXPECT_EQ(light_changed(s.scene, s.pose, now), "a light moved or changed");
    now = s.pose;
    now.light_instances[0].world_from_light[3].x = 1e-6;
    EXPECT_EQ(light_changed(s.scene, s.pose, now), "a light moved or changed");
    now = s.pose;
    now.light_instances.clear();
    EXPECT_EQ(light_changed(s.scene, s.pose, now), "a light moved or changed") << "it was hidden";
    now = s.pose;
    now.world.color = glm::vec3(0.1F);
    EXPECT_EQ(light_changed(s.scene, s.pose, now), "the world's light changed");
    now = s.pose;
    now.materials[0].base_color.r = 0.5F;
    EXPECT_EQ(light_changed(s.scene, s.pose, now), "a material changed");
    now = s.pose;
    now.draws[0].world_from_model[3].x = 1.0;
    EXPECT_EQ(light_changed(s.scene, s.pose, now), "") << "what moves and does not emit is followed";
}

TEST(LightChanged, ASurfaceThatEmitsIsALight) {
    Scene s;
    s.pose.materials[0].emission = glm::vec3(1.0F);
    scene::Pose now = s.pose;
    EXPECT_EQ(light_changed(s.scene, s.pose, now), "");
    now.draws[0].world_from_model[3].x = 1.0;
    EXPECT_EQ(light_changed(s.scene, s.pose, now), "a surface that emits moved");
    now.draws.clear();
    EXPECT_EQ(light_changed(s.scene, s.pose, now), "a surface that emits moved") << "it was hidden";
    // One that deforms may move in any frame.
    s.scene.meshes[0].primitives[0].targets.emplace_back();
    EXPECT_EQ(light_changed(s.scene, s.pose, s.pose), "a surface that emits moved");
}

TEST(SettingsChanged, TellsWhatChangesTheLightFromWhatDoesNot) {
    const Settings before;
    EXPECT_EQ(settings_changed(before, before), "");
    Settings now;
    now.vpls = 1000;
    EXPECT_EQ(settings_changed(before, now), "") << "more lights have the same mean";
    now = {};
    now.height += 1;
    EXPECT_EQ(settings_changed(before, now), "the picture's size changed");
    now = {};
    now.bounces = 2;
    EXPECT_EQ(settings_changed(before, now), "the settings changed");
    now = {};
    now.emitter_vpls = 0;
    EXPECT_EQ(settings_changed(before, now), "the settings changed") << "what emits lights nothing any more";
}

}  // namespace
}  // namespace bounce
