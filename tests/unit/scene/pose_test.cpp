// SPDX-License-Identifier: Apache-2.0
//
// Skins, clips, bounds and the framing camera.
#include "scene/pose.h"

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "gltf_builder.h"
#include "scene/primitive_bounds.h"
#include "scene/scene_features.h"

namespace bounce::scene::test {
namespace {

// A vertex as the renderer will place it: morphed, then moved by its joints. Written from glTF 2.0,
// 3.7.2.2 and 3.7.3.3, apart from the code under test.
glm::dvec3 placed(const Scene& scene, const Pose& pose, const DrawInstance& draw, const Primitive& primitive,
                  size_t v) {
    glm::dvec3 position(primitive.positions[v]);
    for (size_t t = 0; t < primitive.targets.size(); ++t) {
        if (!primitive.targets[t].positions.empty()) {
            position += static_cast<double>(pose.weights[static_cast<size_t>(draw.node)][t]) *
                        glm::dvec3(primitive.targets[t].positions[v]);
        }
    }
    if (draw.skin == k_none) {
        return glm::dvec3(draw.world_from_model * glm::dvec4(position, 1.0));
    }
    const Skin& skin = scene.skins[static_cast<size_t>(draw.skin)];
    glm::dvec3 sum(0.0);
    for (glm::length_t k = 0; k < 4; ++k) {
        const size_t joint = primitive.joints[v][k];
        const glm::dmat4 world_from_mesh = pose.world_from_node[static_cast<size_t>(skin.joints[joint])] *
                                           glm::dmat4(skin.joint_from_mesh[joint]);
        sum += static_cast<double>(primitive.weights[v][k]) *
               glm::dvec3(world_from_mesh * glm::dvec4(position, 1.0));
    }
    return sum;
}

// Two bones along x, the second at x = 1, turned a quarter about z; its bind pose is straight. The mesh
// node itself lies far away, which must not matter.
Scene bent_arm() {
    Scene scene;
    Primitive primitive;
    primitive.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    primitive.normals.assign(3, {0, 0, 1});
    primitive.indices = {0, 1, 2};
    primitive.joints = {{0, 0, 0, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}};
    primitive.weights = {{1, 0, 0, 0}, {0.5F, 0.5F, 0, 0}, {1, 0, 0, 0}};
    scene.meshes.push_back({"arm", {primitive}, {}});
    scene.nodes.resize(3);
    scene.nodes[0].children = {1};
    scene.nodes[1].parent = 0;
    scene.nodes[1].local.translation = {1, 0, 0};
    scene.nodes[1].local.rotation = glm::dquat(std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5));
    scene.nodes[2].mesh = 0;
    scene.nodes[2].skin = 0;
    scene.nodes[2].local.translation = {1000, 0, 0};
    scene.roots = {0, 2};
    scene.topological_order = {0, 1, 2};
    Skin skin;
    skin.joints = {0, 1};
    skin.joint_from_mesh = {glm::mat4(1.0F), glm::translate(glm::mat4(1.0F), glm::vec3(-1, 0, 0))};
    scene.skins.push_back(skin);
    return scene;
}

TEST(PoseTest, SkinsPlaceVerticesByTheirJoints) {
    const Scene scene = bent_arm();
    const Pose pose = evaluate_pose(scene, 0.0);
    ASSERT_EQ(pose.draws.size(), 1U);
    EXPECT_EQ(pose.draws[0].skin, 0);
    EXPECT_EQ(pose.draws[0].world_from_model, glm::dmat4(1.0));
    ASSERT_EQ(pose.skins.at(0).size(), 2U);
    // The hand at (2,0,0) is one beyond the elbow at (1,0,0), which turns it upwards.
    const glm::dvec4 hand = pose.skins[0][1] * glm::dvec4(2, 0, 0, 1);
    EXPECT_NEAR(hand.x, 1.0, 1e-9);
    EXPECT_NEAR(hand.y, 1.0, 1e-9);
    const Bounds bounds = world_bounds(scene, pose);
    EXPECT_NEAR(bounds.low.x, 0.0, 1e-6);
    EXPECT_NEAR(bounds.high.x, 1.0, 1e-6);
    EXPECT_NEAR(bounds.high.y, 1.0, 1e-6);
}

TEST(PoseTest, FarFromTheOriginInDouble) {
    Scene scene = bent_arm();
    scene.nodes[0].local.translation = {1e9, 0, 0};
    const Pose pose = evaluate_pose(scene, 0.0);
    EXPECT_NEAR((pose.skins[0][1] * glm::dvec4(2, 0, 0, 1)).x - 1e9, 1.0, 1e-6);
}

TEST(PoseTest, BoundsContainEveryPlacedVertex) {
    Scene scene = bent_arm();
    MorphTarget target;
    target.positions = {{0, 0, 5}, {0, 0, 0}, {0, -3, 0}};
    scene.meshes[0].primitives[0].targets = {target, target};
    scene.meshes[0].weights = {0.5F, -2.0F};
    for (const bool skinned : {true, false}) {
        scene.nodes[2].skin = skinned ? 0 : k_none;
        const Pose pose = evaluate_pose(scene, 0.0);
        const Bounds bounds = world_bounds(scene, pose);
        for (size_t v = 0; v < 3; ++v) {
            const glm::dvec3 point = placed(scene, pose, pose.draws[0], scene.meshes[0].primitives[0], v);
            EXPECT_TRUE(glm::all(glm::lessThanEqual(bounds.low - 1e-9, point))) << v << skinned;
            EXPECT_TRUE(glm::all(glm::greaterThanEqual(bounds.high + 1e-9, point))) << v << skinned;
        }
    }
}

TEST(PoseTest, BoxesOfTheLoaderGiveTheSameBounds) {
    Scene scene = bent_arm();
    const Pose pose = evaluate_pose(scene, 0.0);
    const Bounds slow = world_bounds(scene, pose);
    scene.meshes[0].primitives[0].bounds = primitive_bounds(scene.meshes[0].primitives[0]);
    const Bounds fast = world_bounds(scene, pose);
    EXPECT_EQ(slow.low, fast.low);
    EXPECT_EQ(slow.high, fast.high);
}

TEST(PoseTest, ClipsAreAlternativesUnlessFromBlender) {
    Scene scene = bent_arm();
    EXPECT_EQ(default_animation(scene), k_all_animations);
    for (const float x : {1.0F, 2.0F}) {
        Animation clip;
        clip.samplers.push_back({Interpolation::step, 3, {0}, {x, 0, 0}});
        clip.channels.push_back({Property::node_translation, 0, 0});
        scene.animations.push_back(clip);
    }
    EXPECT_EQ(default_animation(scene), 0);
    EXPECT_EQ(evaluate_pose(scene, 0.0, 0).world_from_node[0][3].x, 1.0);
    EXPECT_EQ(evaluate_pose(scene, 0.0, 1).world_from_node[0][3].x, 2.0);
    EXPECT_EQ(evaluate_pose(scene, 0.0).world_from_node[0][3].x, 2.0);  // the later one wins
    scene.from_blender = true;
    EXPECT_EQ(default_animation(scene), k_all_animations);
}

TEST(FramingCamera, SeesTheWholeBox) {
    Bounds bounds;
    bounds.grow(glm::dvec3(100, 200, 300));
    bounds.grow(glm::dvec3(101, 205, 302));
    for (const double aspect : {0.5, 1.0, 3.0}) {
        const PlacedCamera placed = framing_camera(bounds, aspect);
        const glm::dmat4 camera_from_world = glm::inverse(placed.world_from_camera);
        EXPECT_NEAR(glm::determinant(glm::dmat3(placed.world_from_camera)), 1.0, 1e-9);
        const double tan_y = std::tan(0.5 * static_cast<double>(placed.camera.yfov_rad));
        for (unsigned corner = 0; corner < 8; ++corner) {
            const glm::dvec3 point((corner & 1U) != 0 ? bounds.high.x : bounds.low.x,
                                   (corner & 2U) != 0 ? bounds.high.y : bounds.low.y,
                                   (corner & 4U) != 0 ? bounds.high.z : bounds.low.z);
            const glm::dvec4 seen = camera_from_world * glm::dvec4(point, 1.0);
            EXPECT_LT(std::abs(seen.y), -seen.z * tan_y);
            EXPECT_LT(std::abs(seen.x), -seen.z * tan_y * aspect);
            EXPECT_GT(-seen.z, static_cast<double>(placed.camera.near_m));
            EXPECT_LT(-seen.z, static_cast<double>(placed.camera.far_m));
        }
    }
}

TEST(FramingCamera, EmptyAndTinyScenes) {
    for (const double size : {0.0, 1e-9}) {
        Bounds bounds;
        if (size > 0.0) {
            bounds.grow(glm::dvec3(0.0));
            bounds.grow(glm::dvec3(size));
        }
        const PlacedCamera placed = framing_camera(bounds, 1.5);
        EXPECT_TRUE(std::isfinite(placed.world_from_camera[3].x));
        EXPECT_GT(placed.camera.near_m, 0.0F);
        EXPECT_GT(placed.camera.far_m, placed.camera.near_m);
    }
}

TEST(Features, OfABareScene) {
    const SceneFeatures features = scene_features(Scene{});
    EXPECT_EQ(features.triangles, 0U);
    EXPECT_FALSE(features.animated());
    EXPECT_FALSE(features.textured());
    EXPECT_FALSE(features.world_not_black);
}

TEST(Features, CountWhatIsDrawn) {
    Scene scene = bent_arm();
    scene.materials.resize(3);
    scene.materials[1].emission = glm::vec3(1.0F);
    scene.materials[1].metallic = 0.0F;
    scene.materials[1].alpha_mode = AlphaMode::mask;
    scene.materials[2].alpha_mode = AlphaMode::blend;  // not used
    scene.meshes[0].primitives[0].material = 1;
    scene.lights.resize(1);
    scene.lights[0].type = LightType::area;
    scene.nodes[1].light = 0;
    const SceneFeatures features = scene_features(scene);
    EXPECT_EQ(features.triangles, 1U);
    EXPECT_EQ(features.vertices, 3U);
    EXPECT_EQ(features.draws, 1);
    EXPECT_EQ(features.materials, 1);
    EXPECT_EQ(features.area_lights, 1);
    EXPECT_TRUE(features.skinned);
    EXPECT_TRUE(features.emissive);
    EXPECT_TRUE(features.alpha_mask);
    EXPECT_FALSE(features.alpha_blend);
    EXPECT_FALSE(features.glossy);  // Blender's default: dielectric, not smooth
    EXPECT_FALSE(features.animated());
}

TEST(Features, WhatAnAnimationMoves) {
    Scene scene = bent_arm();
    scene.cameras.resize(1);
    scene.nodes[0].camera = 0;
    Animation clip;
    clip.samplers.push_back({Interpolation::step, 3, {0}, {0, 0, 0}});
    clip.channels.push_back({Property::node_translation, 1, 0});
    scene.animations = {clip};
    // The elbow carries no mesh, but the skin follows it.
    SceneFeatures features = scene_features(scene);
    EXPECT_TRUE(features.animated_geometry);
    EXPECT_FALSE(features.animated_camera);
    EXPECT_FALSE(features.animated_lights);
    scene.animations[0].channels[0].index = 0;
    EXPECT_TRUE(scene_features(scene).animated_camera);
    scene.animations[0].channels[0] = {Property::world_color, 0, 0};
    features = scene_features(scene);
    EXPECT_TRUE(features.animated_world);
    EXPECT_FALSE(features.animated_geometry);
}

}  // namespace
}  // namespace bounce::scene::test
