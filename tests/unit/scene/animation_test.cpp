// SPDX-License-Identifier: Apache-2.0
//
// Sampling laws against values worked out by hand.
#include <cmath>

#include <gtest/gtest.h>

#include "gltf_builder.h"
#include "scene/pose.h"

namespace bounce::scene::test {
namespace {

using nlohmann::json;

AnimationSampler sampler(Interpolation interpolation, int components, std::vector<float> times,
                         std::vector<float> values) {
    return {interpolation, components, std::move(times), std::move(values)};
}

TEST(Sampling, StepHoldsTheKeyBefore) {
    const AnimationSampler step = sampler(Interpolation::step, 1, {1, 2, 4}, {10, 20, 40});
    EXPECT_EQ(sample(step, 0.0, false)[0], 10.0F);
    EXPECT_EQ(sample(step, 1.999, false)[0], 10.0F);
    EXPECT_EQ(sample(step, 2.0, false)[0], 20.0F);
    EXPECT_EQ(sample(step, 3.9, false)[0], 20.0F);
    EXPECT_EQ(sample(step, 100.0, false)[0], 40.0F);
}

// A file's times are floats, often a little after the frame that they stand for.
TEST(Sampling, AHeldKeyCountsFromItsFrameOnAtAnyRate) {
    for (const double fps : {23.976, 24.0, 25.0, 29.97, 30.0, 60.0}) {
        const FrameRange range{1, 96, fps};
        std::vector<float> times;
        std::vector<float> values;
        for (int frame = 1; frame <= 96; ++frame) {
            times.push_back(static_cast<float>((frame - 1) / fps));
            values.push_back(static_cast<float>(frame));
        }
        const AnimationSampler step = sampler(Interpolation::step, 1, times, values);
        const AnimationSampler line = sampler(Interpolation::linear, 1, times, values);
        for (int frame = 1; frame <= 96; ++frame) {
            const double time_s = time_of_frame(range, frame);
            EXPECT_EQ(sample(step, time_s, false)[0], static_cast<float>(frame)) << fps;
            EXPECT_NEAR(sample(line, time_s, false)[0], frame, 1e-3) << fps;
            EXPECT_EQ(sample(step, time_s + 0.5 / fps, false)[0], static_cast<float>(frame)) << fps;
        }
    }
}

TEST(Sampling, LinearIsClamped) {
    const AnimationSampler line = sampler(Interpolation::linear, 2, {1, 3}, {0, 10, 4, 30});
    EXPECT_EQ(sample(line, -5.0, false), (std::vector<float>{0, 10}));
    EXPECT_EQ(sample(line, 1.5, false), (std::vector<float>{1, 15}));
    EXPECT_EQ(sample(line, 3.0, false), (std::vector<float>{4, 30}));
    EXPECT_EQ(sample(line, 9.0, false), (std::vector<float>{4, 30}));
}

TEST(Sampling, OneKeyIsAConstant) {
    for (const Interpolation kind : {Interpolation::step, Interpolation::linear}) {
        EXPECT_EQ(sample(sampler(kind, 1, {1}, {7}), 0.0, false)[0], 7.0F);
        EXPECT_EQ(sample(sampler(kind, 1, {1}, {7}), 2.0, false)[0], 7.0F);
    }
    EXPECT_EQ(sample(sampler(Interpolation::cubic_spline, 1, {1}, {5, 7, 5}), 2.0, false)[0], 7.0F);
}

// From no turn to a half turn about z: a quarter of the time is an eighth of a turn.
TEST(Sampling, RotationsFollowTheArc) {
    const AnimationSampler turn = sampler(Interpolation::linear, 4, {0, 1}, {0, 0, 0, 1, 0, 0, 1, 0});
    const std::vector<float> value = sample(turn, 0.25, true);
    EXPECT_NEAR(value[2], std::sin(3.14159265 / 8), 1e-6);
    EXPECT_NEAR(value[3], std::cos(3.14159265 / 8), 1e-6);
}

// q and -q are the same rotation: the way from one to nearly the other is short.
TEST(Sampling, RotationsTakeTheShorterArc) {
    const auto s = static_cast<float>(std::sin(0.1));
    const auto c = static_cast<float>(std::cos(0.1));
    const AnimationSampler turn = sampler(Interpolation::linear, 4, {0, 1}, {0, 0, 0, 1, 0, 0, -s, -c});
    const std::vector<float> value = sample(turn, 0.5, true);
    EXPECT_NEAR(value[2], std::sin(0.05), 1e-6);
    EXPECT_NEAR(value[3], std::cos(0.05), 1e-6);
}

TEST(Sampling, RotationsAreNormalised) {
    const AnimationSampler same = sampler(Interpolation::linear, 4, {0, 1}, {0, 0, 0, 2, 0, 0, 0, 2});
    EXPECT_EQ(sample(same, 0.5, true), (std::vector<float>{0, 0, 0, 1}));
    const AnimationSampler none = sampler(Interpolation::step, 4, {0}, {0, 0, 0, 0});
    EXPECT_EQ(sample(none, 0.5, true), (std::vector<float>{0, 0, 0, 1}));
}

// Keys 0 and 1 two seconds apart, out-tangent 3 a second, in-tangent -1 a second; halfway
// p = 0.5 p0 + 0.5 p1 + 2 * (m0 - m1) / 8 = 0.5 + 1 = 1.5.
TEST(Sampling, CubicSplinesScaleTheirTangents) {
    const AnimationSampler spline = sampler(Interpolation::cubic_spline, 1, {0, 2}, {99, 0, 3, -1, 1, 99});
    EXPECT_NEAR(sample(spline, 1.0, false)[0], 1.5F, 1e-6F);
    EXPECT_EQ(sample(spline, 0.0, false)[0], 0.0F);
    EXPECT_EQ(sample(spline, 2.0, false)[0], 1.0F);
    EXPECT_EQ(sample(spline, 3.0, false)[0], 1.0F);
}

TEST(Sampling, CubicRotationsAreNormalised) {
    const AnimationSampler spline =
        sampler(Interpolation::cubic_spline, 4, {0, 1},
                {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0});
    const std::vector<float> value = sample(spline, 0.5, true);
    EXPECT_NEAR(value[2], std::sqrt(0.5F), 1e-6F);
    EXPECT_NEAR(value[3], std::sqrt(0.5F), 1e-6F);
}

// ---- from the file ----

class AnimatedFile : public testing::Test {
  protected:
    // Adds a channel with keys at 0 s and 1 s.
    void channel(json target, const std::vector<float>& values, const std::string& type) {
        const int times = builder_.accessor<float>({0, 1}, "SCALAR");
        const int outputs = builder_.accessor<float>(values, type);
        json& animations = builder_.root["animations"];
        if (animations.empty()) {
            animations.push_back({{"samplers", json::array()}, {"channels", json::array()}});
        }
        animations[0]["samplers"].push_back({{"input", times}, {"output", outputs}});
        animations[0]["channels"].push_back(
            {{"sampler", animations[0]["samplers"].size() - 1}, {"target", std::move(target)}});
    }

    void pointer(const std::string& to, const std::vector<float>& values, const std::string& type) {
        channel({{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", to}}}}}}, values,
                type);
    }

    GltfBuilder builder_;
};

TEST_F(AnimatedFile, NodeTransformsAndWeights) {
    const int mesh = builder_.triangle_mesh();
    const int deltas = builder_.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    builder_.root["meshes"][0]["primitives"][0]["targets"] =
        json::array({json{{"POSITION", deltas}}, json{{"POSITION", deltas}}});
    builder_.node({{"mesh", mesh}, {"weights", {0.5, 0.25}}});
    channel({{"node", 0}, {"path", "translation"}}, {0, 0, 0, 2, 4, 6}, "VEC3");
    channel({{"node", 0}, {"path", "scale"}}, {1, 1, 1, 3, 3, 3}, "VEC3");
    const Scene scene = builder_.load().scene;
    Pose pose = evaluate_pose(scene, 0.5);
    EXPECT_EQ(pose.world_from_node[0][3], glm::dvec4(1, 2, 3, 1));
    EXPECT_EQ(pose.world_from_node[0][0].x, 2.0);
    EXPECT_EQ(pose.weights[0], (std::vector<float>{0.5F, 0.25F}));
    EXPECT_EQ(scene.animations.at(0).duration_s, 1.0F);

    channel({{"node", 0}, {"path", "weights"}}, {0, 1, 1, 0}, "SCALAR");
    pose = evaluate_pose(builder_.load().scene, 0.25);
    EXPECT_EQ(pose.weights[0], (std::vector<float>{0.25F, 0.75F}));
}

TEST_F(AnimatedFile, NormalisedIntegerKeys) {
    builder_.triangle_node();
    const int times = builder_.accessor<float>({0, 1}, "SCALAR");
    const int outputs = builder_.accessor<int16_t>({0, 0, 0, 32767, 0, 0, 32767, 0}, "VEC4", true);
    builder_.add("animations",
                 {{"samplers", {{{"input", times}, {"output", outputs}}}},
                  {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}}});
    const Pose pose = evaluate_pose(builder_.load().scene, 0.5);
    EXPECT_NEAR(pose.world_from_node[0][0].y, 1.0, 1e-6);  // a quarter turn
}

TEST_F(AnimatedFile, PointersOfBlenderFiles) {
    builder_.triangle_node();
    builder_.add("cameras", {{"type", "perspective"},
                             {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}},
                             {"extensions", {{"BOUNCE_scene", {{"focal_length_mm", 50}}}}}});
    builder_.node({{"camera", 0}});
    builder_.add("materials", {{"emissiveFactor", {1, 1, 1}}});
    builder_.root["extensions"]["BOUNCE_scene"] = {
        {"version", 1},
        {"lights", json::array({json{{"type", "spot"}, {"power_w", 1}}})},
        {"world", {{"strength", 1}}}};
    builder_.node({{"extensions", {{"BOUNCE_scene", {{"light", 0}}}}}});
    const std::string light = "/extensions/BOUNCE_scene/lights/0/";
    pointer(light + "power_w", {0, 100}, "SCALAR");
    pointer(light + "irradiance_w_m2", {0, 2}, "SCALAR");
    pointer(light + "color", {0, 0, 0, 1, 0.5, 0}, "VEC3");
    pointer(light + "cone_angle_rad", {0, 1}, "SCALAR");
    pointer(light + "blend", {0, 1}, "SCALAR");
    pointer(light + "radius_m", {0, 4}, "SCALAR");
    pointer(light + "angle_rad", {0, 6}, "SCALAR");
    pointer(light + "size_x_m", {0, 8}, "SCALAR");
    pointer(light + "size_y_m", {0, 10}, "SCALAR");
    pointer(light + "spread_rad", {0, 3}, "SCALAR");
    pointer("/cameras/0/perspective/yfov", {0.5, 1.5}, "SCALAR");
    pointer("/cameras/0/extensions/BOUNCE_scene/focal_length_mm", {50, 100}, "SCALAR");
    pointer("/cameras/0/extensions/BOUNCE_scene/ortho_scale", {2, 4}, "SCALAR");
    pointer("/cameras/0/extensions/BOUNCE_scene/shift_x", {0, 1}, "SCALAR");
    pointer("/cameras/0/extensions/BOUNCE_scene/shift_y", {0, -1}, "SCALAR");
    pointer("/extensions/BOUNCE_scene/world/color", {0, 0, 0, 1, 1, 1}, "VEC3");
    pointer("/extensions/BOUNCE_scene/world/strength", {0, 3}, "SCALAR");
    pointer("/extensions/BOUNCE_scene/view/exposure", {0, -2}, "SCALAR");
    pointer("/nodes/0/extensions/KHR_node_visibility/visible", {1, 0}, "SCALAR");
    builder_.root["animations"][0]["samplers"].back()["interpolation"] = "STEP";
    pointer("/materials/0/pbrMetallicRoughness/baseColorFactor", {0, 0, 0, 0, 1, 1, 1, 1}, "VEC4");
    pointer("/materials/0/pbrMetallicRoughness/metallicFactor", {0, 1}, "SCALAR");
    pointer("/materials/0/pbrMetallicRoughness/roughnessFactor", {1, 0}, "SCALAR");
    pointer("/materials/0/emissiveFactor", {0, 0, 0, 1, 1, 1}, "VEC3");
    pointer("/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength", {0, 20}, "SCALAR");

    const LoadResult result = builder_.load();
    EXPECT_TRUE(result.warnings.empty());
    const Pose pose = evaluate_pose(result.scene, 0.5);
    const Light& spot = pose.lights.at(0);
    EXPECT_EQ(spot.power_w, 50.0F);
    EXPECT_EQ(spot.irradiance_w_m2, 1.0F);
    EXPECT_EQ(spot.color, glm::vec3(0.5F, 0.25F, 0.0F));
    EXPECT_EQ(spot.cone_angle_rad, 0.5F);
    EXPECT_EQ(spot.blend, 0.5F);
    EXPECT_EQ(spot.radius_m, 2.0F);
    EXPECT_EQ(spot.angle_rad, 3.0F);
    EXPECT_EQ(spot.size_x_m, 4.0F);
    EXPECT_EQ(spot.size_y_m, 5.0F);
    EXPECT_EQ(spot.spread_rad, 1.5F);
    EXPECT_EQ(pose.cameras.at(0).yfov_rad, 1.0F);
    EXPECT_EQ(pose.cameras[0].sensor->focal_length_mm, 75.0F);
    EXPECT_EQ(pose.cameras[0].sensor->ortho_scale, 3.0F);
    EXPECT_EQ(pose.cameras[0].sensor->shift_x, 0.5F);
    EXPECT_EQ(pose.cameras[0].sensor->shift_y, -0.5F);
    EXPECT_EQ(pose.world.color, glm::vec3(0.5F));
    EXPECT_EQ(pose.world.strength, 1.5F);
    EXPECT_EQ(pose.view.exposure, -1.0F);
    EXPECT_EQ(pose.materials.at(0).base_color, glm::vec4(0.5F));
    EXPECT_EQ(pose.materials[0].metallic, 0.5F);
    EXPECT_EQ(pose.materials[0].roughness, 0.5F);
    // Factor 0.5 times strength 10.
    EXPECT_EQ(pose.materials[0].emission, glm::vec3(5.0F));
    EXPECT_EQ(pose.materials[0].emission_strength, 1.0F);
    EXPECT_EQ(pose.draws.size(), 1U);
    EXPECT_TRUE(evaluate_pose(result.scene, 1.0).draws.empty());
}

TEST_F(AnimatedFile, PunctualPointersConvertUnits) {
    builder_.root["extensions"]["KHR_lights_punctual"]["lights"] =
        json::array({json{{"type", "spot"}}, json{{"type", "directional"}}});
    builder_.node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    builder_.node({{"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}});
    const std::string lights = "/extensions/KHR_lights_punctual/lights/";
    pointer(lights + "0/intensity", {0, 1366}, "SCALAR");
    pointer(lights + "1/intensity", {0, 1366}, "SCALAR");
    pointer(lights + "0/spot/outerConeAngle", {0, 1}, "SCALAR");
    pointer(lights + "0/spot/innerConeAngle", {0, 0.5}, "SCALAR");
    pointer(lights + "0/range", {0, 1}, "SCALAR");
    const LoadResult result = builder_.load();
    EXPECT_TRUE(result.warnings.empty());
    const Pose pose = evaluate_pose(result.scene, 0.5);
    EXPECT_NEAR(pose.lights[0].power_w, 4.0 * 3.14159265, 1e-4);
    EXPECT_NEAR(pose.lights[1].irradiance_w_m2, 1.0, 1e-6);
    EXPECT_EQ(pose.lights[0].cone_angle_rad, 1.0F);
    EXPECT_EQ(pose.lights[0].inner_cone_rad, 0.25F);
}

TEST_F(AnimatedFile, BlendersPointerCountsWhereBothMoveALight) {
    builder_.root["extensions"]["KHR_lights_punctual"]["lights"] = json::array({json{{"type", "point"}}});
    builder_.root["extensions"]["BOUNCE_scene"] = {
        {"version", 1}, {"lights", json::array({json{{"type", "point"}, {"power_w", 1}}})}};
    builder_.node(
        {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}, {"BOUNCE_scene", {{"light", 0}}}}}});
    pointer("/extensions/BOUNCE_scene/lights/0/power_w", {0, 2}, "SCALAR");
    pointer("/extensions/KHR_lights_punctual/lights/0/intensity", {0, 9999}, "SCALAR");
    EXPECT_EQ(evaluate_pose(builder_.load().scene, 1.0).lights.at(0).power_w, 2.0F);
}

TEST_F(AnimatedFile, WhatCannotBePlayedWarns) {
    builder_.node(
        {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}, {"mesh", builder_.triangle_mesh()}});
    channel({{"node", 0}, {"path", "translation"}}, {0, 0, 0, 1, 1, 1}, "VEC3");
    channel({{"node", 0}, {"path", "weights"}}, {0, 1}, "SCALAR");
    pointer("/materials/0/normalTexture/scale", {0, 1}, "SCALAR");
    const LoadResult result = builder_.load();
    EXPECT_EQ(result.warnings.size(), 3U);
    EXPECT_TRUE(result.scene.animations.at(0).channels.empty());
}

TEST_F(AnimatedFile, KeysAtTheSameTime) {
    builder_.triangle_node();
    const int times = builder_.accessor<float>({0, 1, 1, 1, 2}, "SCALAR");
    const int outputs = builder_.accessor<float>({0, 0, 0, 1, 0, 0, 9, 0, 0, 5, 0, 0, 6, 0, 0}, "VEC3");
    builder_.add("animations",
                 {{"samplers", {{{"input", times}, {"output", outputs}}}},
                  {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}});
    const Scene scene = builder_.load().scene;
    EXPECT_EQ(scene.animations[0].samplers[0].times, (std::vector<float>{0, 1, 1, 2}));
    EXPECT_EQ(evaluate_pose(scene, 0.5).world_from_node[0][3].x, 0.5) << "towards the first of them";
    EXPECT_EQ(evaluate_pose(scene, 1.0).world_from_node[0][3].x, 5.0);
    EXPECT_EQ(evaluate_pose(scene, 1.5).world_from_node[0][3].x, 5.5);
}

}  // namespace
}  // namespace bounce::scene::test
