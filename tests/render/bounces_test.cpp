// SPDX-License-Identifier: Apache-2.0
//
// Light that bounces more than once, what moves while it does, and which points are moved for it.
#include "gpu/point_store.h"
#include "ism_fixture.h"

namespace bounce::test {
namespace {

class Bounces : public ::testing::Test {
  protected:
    void SetUp() override { require_context(); }

    // A closed box of side 2 with a point light in its middle.
    static scene::Scene furnace(float albedo) {
        scene::Scene scene;
        scene.from_blender = true;
        const int square = add_square(scene, 2.0F, add_diffuse(scene, glm::vec3(albedo)));
        const double turns[6][4] = {{0, 1, 0, 0},   {180, 1, 0, 0}, {90, 1, 0, 0},
                                    {-90, 1, 0, 0}, {90, 0, 1, 0},  {-90, 0, 1, 0}};
        for (const auto& turn : turns) {
            add_mesh_node(scene, square,
                          rotated(turn[0], {turn[1], turn[2], turn[3]}) * moved({0.0, 0.0, -1.0}));
        }
        add_light(scene, light_of(scene::LightType::point), glm::dmat4(1.0));
        return scene;
    }
    static double wall_mean(const scene::Scene& scene, int bounces, bool splat) {
        CameraView camera = camera_from_above(2.0, 0.5);
        camera.camera.far_m = 10.0F;
        Settings settings = bounced(48);
        settings.bounces = bounces;
        settings.vpls = 256;
        settings.bounce_vpls = 256;
        settings.bounce_source = splat ? BounceSource::irsm : BounceSource::points;
        return draw(scene, camera, settings).mean();
    }
};

TEST_F(Bounces, OfAFurnaceAreAGeometricSeries) {
    // Irradiance of bounce k, averaged over all walls, is albedo^k times the direct one, P / area; one wall
    // is all of them by symmetry.
    for (const float albedo : {0.4F, 0.8F}) {
        const scene::Scene scene = furnace(albedo);
        for (const bool splat : {false, true}) {
            double sum = 0.0;
            for (int bounces = 1; bounces <= 4; ++bounces) {
                sum += static_cast<double>(albedo) / pi * std::pow(static_cast<double>(albedo), bounces) *
                       100.0 / 24.0;
                const double mean = wall_mean(scene, bounces, splat);
                // Bounding 1/d^2 takes 1 % along the edges. Splatted maps have disks twice as wide as their
                // points' areas, so that no light is lost between them, and find too much a bounce.
                EXPECT_NEAR(mean / sum, 1.0, splat ? 0.05 : 0.015)
                    << "albedo " << albedo << ", " << bounces << " bounces, splatted " << splat;
            }
        }
    }
}

// A pointer on a wall and something that moves between it and the floor.
class MovingShadow : public Bounces {
  protected:
    static constexpr int size = 40;
    static Settings settings() {
        Settings s = bounced(size);
        s.vpls = 16;
        s.interleave = 1;
        return s;
    }
    // Middle of what is dark on the floor, by comparison with the same frame without visibility.
    static glm::dvec2 shadow(Renderer& renderer, const scene::Scene& scene, double time_s) {
        const scene::Pose pose = scene::evaluate_pose(scene, time_s);
        const auto frame = [&](Visibility visibility) {
            Settings s = settings();
            s.visibility = visibility;
            renderer.render(pose, floor_camera(), s);
            return renderer.read_color();
        };
        const Image open = frame(Visibility::none);
        const Image hidden = frame(Visibility::ism);
        glm::dvec2 sum(0.0);
        double count = 0.0;
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                const size_t i = hidden.offset(x, y);
                if (hidden.rgb[i] < 0.5F * open.rgb[i]) {
                    sum += glm::dvec2(4.0 * ((x + 0.5) / size - 0.5), 4.0 * (0.5 - (y + 0.5) / size));
                    count += 1.0;
                }
            }
        }
        EXPECT_GT(count, 10.0);
        return sum / count;
    }
    static void move_node(scene::Scene& scene, int node, const std::vector<float>& from,
                          const std::vector<float>& to, scene::Property property) {
        scene.frames = {1, 2, 1.0};
        scene::Animation animation;
        std::vector<float> values = from;
        values.insert(values.end(), to.begin(), to.end());
        animation.samplers.push_back(
            {scene::Interpolation::linear, static_cast<int>(from.size()), {0.0F, 1.0F}, values});
        animation.channels.push_back({property, node, 0});
        animation.duration_s = 1.0F;
        scene.animations.push_back(animation);
    }
    // From y = -0.4 to y = 0.4 over a second, half way between the light and the floor: the shadow goes twice
    // as far.
    static void expect_follows(const scene::Scene& scene) {
        Renderer renderer(scene);
        for (const double time : {0.0, 1.0, 0.5, 0.0}) {
            const glm::dvec2 at = shadow(renderer, scene, time);
            EXPECT_NEAR(at.y, 2.0 * (-0.4 + 0.8 * time), 0.12) << "seconds " << time;
            EXPECT_NEAR(at.x, 0.0, 0.4) << "seconds " << time;  // a box's reaches beyond its middle's
        }
    }
};

TEST_F(MovingShadow, OfARigidMesh) {
    scene::Scene scene = corner_scene();
    add_pointer(scene);
    scene::Node ball;
    ball.mesh = add_ball(scene, add_diffuse(scene), 0.2F);
    const int node = add_node(scene, ball);
    move_node(scene, node, {-1.0F, -0.4F, 0.75F}, {-1.0F, 0.4F, 0.75F}, scene::Property::node_translation);
    expect_follows(scene);
}

TEST_F(MovingShadow, OfASkinnedMesh) {
    scene::Scene scene = corner_scene();
    add_pointer(scene);
    const int mesh = add_ball(scene, add_diffuse(scene), 0.2F);
    scene::Primitive& primitive = scene.meshes[static_cast<size_t>(mesh)].primitives[0];
    primitive.joints.assign(primitive.positions.size(), glm::u16vec4(0));
    primitive.weights.assign(primitive.positions.size(), glm::vec4(1.0F, 0.0F, 0.0F, 0.0F));
    const int joint = add_node(scene, {});
    scene::Skin skin;
    skin.joints = {joint};
    skin.joint_from_mesh = {glm::mat4(1.0F)};
    scene.skins.push_back(skin);
    const int node = add_mesh_node(scene, mesh, moved({7.0, 7.0, 7.0}));  // must not count
    scene.nodes[static_cast<size_t>(node)].skin = 0;
    move_node(scene, joint, {-1.0F, -0.4F, 0.75F}, {-1.0F, 0.4F, 0.75F}, scene::Property::node_translation);
    expect_follows(scene);
}

TEST_F(MovingShadow, OfAMorphingMesh) {
    scene::Scene scene = corner_scene();
    add_pointer(scene);
    const int mesh = add_ball(scene, add_diffuse(scene), 0.2F);
    scene::Primitive& primitive = scene.meshes[static_cast<size_t>(mesh)].primitives[0];
    scene::MorphTarget aside;
    aside.positions.assign(primitive.positions.size(), glm::vec3(0.0F, 0.8F, 0.0F));
    primitive.targets = {aside};
    const int node = add_mesh_node(scene, mesh, moved({-1.0, -0.4, 0.75}));
    scene.nodes[static_cast<size_t>(node)].weights = {0.0F};
    move_node(scene, node, {0.0F}, {1.0F}, scene::Property::node_weights);
    expect_follows(scene);
}

TEST_F(MovingShadow, OfAWholeTriangle) {
    // A box that is drawn as triangles, without a point.
    scene::Scene scene = corner_scene();
    add_pointer(scene);
    scene::Node box;
    box.mesh = add_box(scene, glm::vec3(0.2F), add_diffuse(scene));
    const int node = add_node(scene, box);
    move_node(scene, node, {-1.0F, -0.4F, 0.75F}, {-1.0F, 0.4F, 0.75F}, scene::Property::node_translation);
    expect_follows(scene);
}

// Which points are moved.
class PointUpdates : public Bounces {
  protected:
    static size_t changed_points(const gpu::PointStore& store) {
        size_t count = 0;
        for (const gpu::PointRun& run : store.changed()) {
            count += run.count;
        }
        return count;
    }
};

TEST_F(PointUpdates, OnlyWhatMovedIsMoved) {
    scene::Scene scene = corner_scene();
    add_pointer(scene);
    const int ball = add_ball(scene, 0, 0.3F);
    add_mesh_node(scene, ball, moved({-1.0, 1.0, 0.75}));
    scene::Node moving;
    moving.mesh = ball;
    const int node = add_node(scene, moving);
    add_mesh_node(scene, ball, moved({1.0, 1.0, 0.75}));
    scene.frames = {1, 2, 1.0};
    scene::Animation animation;
    animation.samplers.push_back({scene::Interpolation::linear, 3, {0.0F, 1.0F}, {0, 0, 1, 0, 0, 2}});
    animation.channels.push_back({scene::Property::node_translation, node, 0});
    scene.animations.push_back(animation);
    gpu::GpuScene gpu_scene(scene);
    gpu::PointStore store(scene, scene::k_all_animations);
    scene::PointCounts counts;
    counts.points_a_map = 512;
    counts.occluders = 4096;
    counts.large_triangles = false;
    const auto pose_at = [&](double time) {
        const scene::Pose pose = scene::evaluate_pose(scene, time);
        gpu_scene.set_pose(pose);
        store.set_pose(pose, gpu_scene.space(), gpu_scene.vertices(), counts, false, false);
    };
    pose_at(0.0);
    EXPECT_EQ(changed_points(store), 4096U) << "all of them are new";
    pose_at(0.0);
    EXPECT_EQ(changed_points(store), 4096U) << "nobody has moved them yet";
    store.update_done();
    EXPECT_FALSE(store.any_changed());
    pose_at(0.0);
    EXPECT_FALSE(store.any_changed()) << "nothing moved";
    pose_at(1.0);
    // A ball's part of the area: floor and wall have 16 m^2 each, balls 4 pi 0.09.
    const double sphere = 4.0 * pi * 0.09;
    EXPECT_NEAR(static_cast<double>(changed_points(store)), 4096.0 * sphere / (32.0 + 3.0 * sphere), 3.0);
    EXPECT_EQ(store.changed().size(), 1U) << "one run";
    store.update_done();
    pose_at(1.0);
    EXPECT_FALSE(store.any_changed());
    counts.occluders = 2048;
    pose_at(1.0);
    EXPECT_EQ(changed_points(store), 2048U) << "another count, other points";
}

TEST_F(PointUpdates, WhatDeformsIsMovedWhereItDoes) {
    scene::Scene scene = corner_scene();
    const int ball = add_ball(scene, 0, 0.3F);
    scene::MorphTarget aside;
    aside.positions.assign(scene.meshes[static_cast<size_t>(ball)].primitives[0].positions.size(),
                           glm::vec3(0.1F));
    scene.meshes[static_cast<size_t>(ball)].primitives[0].targets = {aside};
    const int node = add_mesh_node(scene, ball, moved({0.0, 0.0, 1.0}));
    scene.nodes[static_cast<size_t>(node)].weights = {0.5F};
    gpu::GpuScene gpu_scene(scene);
    gpu::PointStore store(scene, scene::k_all_animations);
    scene::PointCounts counts;
    counts.points_a_map = 512;
    counts.occluders = 4096;
    counts.large_triangles = false;
    scene::Pose pose = scene::evaluate_pose(scene, 0.0);
    gpu_scene.set_pose(pose);
    store.set_pose(pose, gpu_scene.space(), gpu_scene.vertices(), counts, false, false);
    store.update_done();
    store.set_pose(pose, gpu_scene.space(), gpu_scene.vertices(), counts, false, false);
    EXPECT_EQ(changed_points(store), 0U) << "it rests";
    pose.weights[static_cast<size_t>(node)] = {0.75F};
    gpu_scene.set_pose(pose);
    store.set_pose(pose, gpu_scene.space(), gpu_scene.vertices(), counts, false, false);
    EXPECT_GT(changed_points(store), 50U);
    EXPECT_LT(changed_points(store), 400U) << "the ball's alone";
}

TEST_F(PointUpdates, LargeTrianglesAreMovedToo) {
    scene::Scene scene = corner_scene();
    scene::Node box;
    box.mesh = add_box(scene, glm::vec3(0.3F), 0);
    const int node = add_node(scene, box);
    scene.frames = {1, 2, 1.0};
    scene::Animation animation;
    animation.samplers.push_back({scene::Interpolation::linear, 3, {0.0F, 1.0F}, {0, 0, 1, 0, 0, 2}});
    animation.channels.push_back({scene::Property::node_translation, node, 0});
    scene.animations.push_back(animation);
    gpu::GpuScene gpu_scene(scene);
    gpu::PointStore store(scene, scene::k_all_animations);
    scene::PointCounts counts;
    counts.points_a_map = 512;
    counts.occluders = 4096;
    const auto pose_at = [&](double time) {
        const scene::Pose pose = scene::evaluate_pose(scene, time);
        gpu_scene.set_pose(pose);
        store.set_pose(pose, gpu_scene.space(), gpu_scene.vertices(), counts, true, false);
    };
    pose_at(0.0);
    EXPECT_EQ(store.large_triangles(), 12U);
    EXPECT_EQ(store.occluders(), 0U) << "floor and wall are on the hull";
    EXPECT_TRUE(store.any_changed());
    store.update_done();
    pose_at(0.0);
    EXPECT_FALSE(store.any_changed());
    pose_at(0.5);
    EXPECT_TRUE(store.any_changed());
    EXPECT_TRUE(store.changed().empty()) << "no points";
}

}  // namespace
}  // namespace bounce::test
