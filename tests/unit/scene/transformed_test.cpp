// SPDX-License-Identifier: Apache-2.0
//
// Scenes told in other numbers, another order and other meshes: what of them must be the same is.
#include "scene/transformed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "made_scenes.h"
#include "point_samples.h"
#include "scene/points/deformed_positions.h"
#include "scene/rearranged.h"

namespace bounce::scene::test {
namespace {

// Two boxes and a moving one below a turned node, an animated lamp and sun, a camera, a world and emission.
Scene mixed() {
    Scene scene;
    const int boxes = add_mesh(scene, box({0.5F, 1.0F, 2.0F}));
    place_mesh(scene, boxes, moved({3.0, 0.0, 0.0}) * turned(0.3));
    place_mesh(scene, add_mesh(scene, box(glm::vec3(0.25F))), moved({-2.0, 1.0, 0.0}));
    place_mesh(scene, add_mesh(scene, square(6.0F)));
    Node moving;
    moving.mesh = boxes;
    const int node = add_node(scene, moving);
    scene.materials.resize(2);
    scene.materials[1].emission = glm::vec3(2.0F);
    scene.meshes[1].primitives[0].material = 1;
    Light lamp;
    lamp.power_w = 100.0F;
    lamp.radius_m = 0.1F;
    Light sun;
    sun.type = LightType::sun;
    sun.irradiance_w_m2 = 3.0F;
    scene.lights = {lamp, sun};
    for (const int light : {0, 1}) {
        Node of_light;
        of_light.light = light;
        of_light.local.translation = {1.0, 4.0, light};
        add_node(scene, of_light);
    }
    scene.cameras.resize(1);
    Node camera;
    camera.camera = 0;
    camera.local.translation = {0.0, 0.0, 9.0};
    scene.active_camera_node = add_node(scene, camera);
    scene.world.color = glm::vec3(0.5F);
    scene.frames = {1, 2, 1.0};
    Animation animation;
    animation.samplers = {{Interpolation::linear, 3, {0.0F, 1.0F}, {0, 0, 0, 1, 2, 3}},
                          {Interpolation::linear, 1, {0.0F, 1.0F}, {100.0F, 50.0F}}};
    animation.channels = {{Property::node_translation, node, 0},
                          {Property::light_power_w, 0, 1},
                          {Property::material_emission_strength, 1, 1}};
    scene.animations = {animation};
    return scene;
}

// What a pose shows, in an order of its own: triangles' corners and materials' emission.
std::vector<std::array<double, 12>> shown(const Scene& scene, double time_s) {
    std::vector<std::array<double, 12>> out;
    const Pose pose = evaluate_pose(scene, time_s);
    for (const DrawInstance& draw : pose.draws) {
        for (const Primitive& p : scene.meshes[static_cast<size_t>(draw.mesh)].primitives) {
            for (size_t i = 0; i + 2 < p.indices.size(); i += 3) {
                std::array<double, 12> entry{};
                for (size_t c = 0; c < 3; ++c) {
                    const glm::dvec3 at(draw.world_from_model *
                                        glm::dvec4(glm::dvec3(p.positions[p.indices[i + c]]), 1.0));
                    for (size_t axis = 0; axis < 3; ++axis) {
                        // Rounded, so that what rounding moves keeps its place in the order.
                        entry[3 * c + axis] = std::round(at[static_cast<int>(axis)] * 1e4) / 1e4;
                    }
                }
                if (p.material != k_none) {
                    entry[9] =
                        static_cast<double>(pose.materials[static_cast<size_t>(p.material)].emission.r);
                }
                out.push_back(entry);
            }
        }
    }
    std::sort(out.begin(), out.end());
    return out;
}

TEST(Transformed, ScalingScalesPlacesAndPower) {
    const Scene scene = mixed();
    const Scene large = scaled(scene, 1000.0);
    for (const double time : {0.0, 0.5}) {
        const Pose a = evaluate_pose(scene, time);
        const Pose b = evaluate_pose(large, time);
        const Bounds was = world_bounds(scene, a);
        const Bounds is = world_bounds(large, b);
        EXPECT_LT(glm::distance(is.low, 1000.0 * was.low), 1e-3);
        EXPECT_LT(glm::distance(is.high, 1000.0 * was.high), 1e-3);
        EXPECT_FLOAT_EQ(b.lights[0].power_w, 1e6F * a.lights[0].power_w);
        EXPECT_FLOAT_EQ(b.lights[0].radius_m, 1e3F * a.lights[0].radius_m);
        EXPECT_EQ(b.lights[1].irradiance_w_m2, a.lights[1].irradiance_w_m2);
        EXPECT_EQ(b.materials[1].emission, a.materials[1].emission);
        EXPECT_EQ(b.world.color, a.world.color);
        EXPECT_FLOAT_EQ(b.cameras[0].near_m, 1e3F * a.cameras[0].near_m);
    }
}

TEST(Transformed, MovingMovesAllAndKeepsDifferences) {
    const Scene scene = mixed();
    const Scene far_away = moved(scene, {1e6, -1e6, 1e6});
    const Pose a = evaluate_pose(scene, 0.5);
    const Pose b = evaluate_pose(far_away, 0.5);
    ASSERT_EQ(a.draws.size(), b.draws.size());
    for (size_t i = 0; i < a.draws.size(); ++i) {
        const glm::dvec3 by(b.draws[i].world_from_model[3] - a.draws[i].world_from_model[3]);
        EXPECT_LT(glm::distance(by, {1e6, -1e6, 1e6}), 1e-8);
    }
    EXPECT_EQ(a.light_instances.size(), b.light_instances.size());
    const auto camera = static_cast<size_t>(far_away.active_camera_node);
    EXPECT_NEAR(b.world_from_node[camera][3].z, 1e6 + 9.0, 1e-8);
}

TEST(Transformed, TurningTurnsTheWorldsImageToo) {
    const glm::dquat by = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1.0, 2.0, 3.0)));
    const Scene scene = mixed();
    const Scene other = turned(scene, by);
    const Pose a = evaluate_pose(scene, 0.5);
    const Pose b = evaluate_pose(other, 0.5);
    for (size_t i = 0; i < a.draws.size(); ++i) {
        EXPECT_LT(glm::distance(glm::dvec3(b.draws[i].world_from_model[3]),
                                by * glm::dvec3(a.draws[i].world_from_model[3])),
                  1e-12);
    }
    EXPECT_LT(glm::distance(b.world.world_from_environment * glm::dvec3(1.0, 0.0, 0.0),
                            by * glm::dvec3(1.0, 0.0, 0.0)),
              1e-12);
}

TEST(Transformed, RelightingMultipliesAllLight) {
    const Scene scene = mixed();
    const Pose a = evaluate_pose(scene, 0.5);
    const Pose b = evaluate_pose(relit(scene, 1e-6), 0.5);
    EXPECT_FLOAT_EQ(b.lights[0].power_w, 1e-6F * a.lights[0].power_w);
    EXPECT_FLOAT_EQ(b.lights[1].irradiance_w_m2, 1e-6F * a.lights[1].irradiance_w_m2);
    EXPECT_FLOAT_EQ(b.materials[1].emission.r, 1e-6F * a.materials[1].emission.r);
    EXPECT_FLOAT_EQ(b.world.color.r * b.world.strength, 1e-6F * a.world.color.r * a.world.strength);
}

TEST(Rearranged, ShowsTheSameTriangles) {
    const Scene scene = mixed();
    for (const double time : {0.0, 0.5}) {
        const auto before = shown(scene, time);
        EXPECT_EQ(shown(with_meshes_split(scene), time), before);
        EXPECT_EQ(shown(with_meshes_merged(scene), time), before);
        EXPECT_EQ(shown(reordered(scene), time), before);
    }
    EXPECT_EQ(evaluate_pose(with_meshes_split(scene), 0.0).draws.size(), 8U);
    EXPECT_EQ(evaluate_pose(with_meshes_merged(scene), 0.0).draws.size(), 3U)
        << "box and square; the others share";
    const Scene other = reordered(scene);
    EXPECT_EQ(other.nodes[static_cast<size_t>(other.active_camera_node)].camera, 0);
    EXPECT_FLOAT_EQ(evaluate_pose(other, 1.0).lights[1].power_w, 50.0F) << "the lamp is the second now";
}

// Places of a sequence's points, over the scene's diagonal from its middle.
std::vector<glm::dvec3> places(const Scene& scene, const std::vector<PointSample>& points,
                               const SurfaceParts& parts) {
    const Pose pose = evaluate_pose(scene, 0.0);
    const Bounds bounds = world_bounds(scene, pose);
    std::vector<glm::dvec3> out;
    for (const PointSample& point : points) {
        const PointSurface& surface = parts.surfaces[point.surface];
        const auto at = deformed_positions(scene, pose, surface);
        const glm::dvec3 a = at[point.triangle.x];
        const glm::dvec3 place = a + (at[point.triangle.y] - a) * static_cast<double>(point.second) +
                                 (at[point.triangle.z] - a) * static_cast<double>(point.third);
        out.push_back((place - bounds.center()) / bounds.diagonal());
    }
    return out;
}

TEST(PointOrder, IsThatOfPlacesWhateverTheScenesOrderAndNumbers) {
    const Scene scene = mixed();
    const auto sampled = [](const Scene& of) {
        const SurfaceParts parts = surface_parts(of, k_all_animations);
        PointCounts counts = occluders(512, 256, true);
        counts.reflectors = 512;
        counts.reflectors_a_map = 256;
        const PointSet set = sample_points(parts, none_on_hull(parts), counts);
        return std::pair(places(of, set.occluders, parts), places(of, set.reflectors, parts));
    };
    const auto [occluding, reflecting] = sampled(scene);
    ASSERT_EQ(occluding.size(), 512U);
    for (const Scene& other : {reordered(scene), scaled(scene, 1e-3), scaled(scene, 1e5),
                               moved(scene, {1e6, -1e6, 1e6}), moved(reordered(scene), {-1e6, 1e6, 0.0})}) {
        const auto [occluding_there, reflecting_there] = sampled(other);
        for (size_t i = 0; i < 512; ++i) {
            ASSERT_LT(glm::distance(occluding_there[i], occluding[i]), 1e-6) << i;
            // A step of the curve through a triangle is a 256th of it.
            ASSERT_LT(glm::distance(reflecting_there[i], reflecting[i]), 5e-3) << i;
        }
    }
}

// Weights in floats that sum up to 1 + 6e-8 only: at 10^6 m that is 6 cm.
TEST(PointOrder, SkinnedSurfacesFarFromTheOriginKeepTheirArea) {
    Scene scene;
    Primitive p = box({0.5F, 1.0F, 2.0F});
    p.joints.assign(p.positions.size(), glm::u16vec4(0));
    for (size_t i = 0; i < p.positions.size(); ++i) {
        p.weights.emplace_back(i % 2 == 0 ? 1.0F : 1.0F + 1.2e-7F, 0.0F, 0.0F, 0.0F);
    }
    const int joint = add_node(scene, {});
    Skin skin;
    skin.joints = {joint};
    skin.joint_from_mesh = {glm::mat4(1.0F)};
    scene.skins = {skin};
    const int node = place_mesh(scene, add_mesh(scene, p));
    scene.nodes[static_cast<size_t>(node)].skin = 0;
    const double area = surface_parts(scene, k_all_animations).area_m2();
    EXPECT_NEAR(area, 28.0, 1e-4);
    const SurfaceParts far_away = surface_parts(moved(scene, {1e6, -1e6, 1e6}), k_all_animations);
    EXPECT_NEAR(far_away.area_m2(), area, 1e-6);
}

}  // namespace
}  // namespace bounce::scene::test
