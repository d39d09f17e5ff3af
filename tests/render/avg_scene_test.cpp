// SPDX-License-Identifier: Apache-2.0
//
// Grids of scenes: what moves and deforms is where it is in the frame, and light of the world and of emissive
// surfaces bounces through them as that of lights does.
#include "avg_fixture.h"

namespace bounce::test {
namespace {

class AvgOfAScene : public ::testing::Test {
  protected:
    void SetUp() override { require_context(); }

    static void animate(scene::Scene& scene, int node, scene::Property property,
                        const std::vector<float>& from, const std::vector<float>& to) {
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
    // Every place of a box's sides is in the grid, and nothing else.
    static void expect_box(const ReadGrid& grid, const std::vector<glm::vec3>& corners, const char* what) {
        std::mt19937 random(31);
        std::uniform_real_distribution<double> part(0.01, 0.49);
        double area = 0.0;
        for (size_t i = 0; i < corners.size(); i += 3) {
            const glm::dvec3 a(corners[i]);
            const glm::dvec3 ab = glm::dvec3(corners[i + 1]) - a;
            const glm::dvec3 ac = glm::dvec3(corners[i + 2]) - a;
            area += 0.5 * glm::length(glm::cross(ab, ac));
            for (int k = 0; k < 20; ++k) {
                ASSERT_TRUE(holds(grid, a + part(random) * ab + part(random) * ac, glm::cross(ab, ac)))
                    << what << ", triangle " << i / 3;
            }
        }
        EXPECT_NEAR(grid.area_m2() / area, 1.0, 0.01) << what;
    }
};

TEST_F(AvgOfAScene, ThingsThatMoveAreWhereTheyAreInTheFrame) {
    const std::vector<glm::vec3> corners = box_triangles(glm::vec3(0.5F, 0.3F, 0.2F), 4);
    scene::Scene scene;
    scene.from_blender = true;
    const int mesh = add_triangles(scene, corners, add_diffuse(scene));
    scene::Node node;
    node.mesh = mesh;
    animate(scene, add_node(scene, node), scene::Property::node_translation, {0.0F, 0.0F, 0.0F},
            {3.0F, 0.7F, -0.4F});                 // far out of the grid that it begins in
    for (const double time : {0.0, 0.45, 1.0}) {  // no side on the border of two voxels
        std::vector<glm::vec3> now = corners;
        for (glm::vec3& corner : now) {
            corner += static_cast<float>(time) * glm::vec3(3.0F, 0.7F, -0.4F);
        }
        SCOPED_TRACE(time);
        expect_box(trace(scene, traced(32), time).grid, now, "moved");
    }
}

TEST_F(AvgOfAScene, ThingsThatDeformAreWhereTheyAreInTheFrame) {
    const std::vector<glm::vec3> corners = box_triangles(glm::vec3(0.5F, 0.3F, 0.2F), 4);
    scene::Scene scene;
    scene.from_blender = true;
    const int mesh = add_triangles(scene, corners, add_diffuse(scene));
    scene::MorphTarget wider;
    for (const glm::vec3& corner : corners) {
        wider.positions.push_back(2.0F * corner);
    }
    scene.meshes[static_cast<size_t>(mesh)].primitives[0].targets = {wider};
    const int node = add_mesh_node(scene, mesh, rotated(30.0, {0.0, 1.0, 0.3}));
    scene.nodes[static_cast<size_t>(node)].weights = {0.0F};
    animate(scene, node, scene::Property::node_weights, {0.0F}, {1.0F});
    for (const double time : {0.0, 0.4, 1.0}) {
        std::vector<glm::vec3> now;
        for (const glm::vec3& corner : corners) {
            now.emplace_back(rotated(30.0, {0.0, 1.0, 0.3}) *
                             glm::dvec4(glm::dvec3(corner) * (1.0 + 2.0 * time), 1.0));
        }
        SCOPED_TRACE(time);
        expect_box(trace(scene, traced(32), time).grid, now, "deformed");
    }
}

TEST_F(AvgOfAScene, LightIsKeptInAClosedBoxThatDeforms) {
    // A box of walls that bend inwards, with the light in it.
    const std::vector<glm::vec3> corners = box_triangles(glm::vec3(1.0F), 16);
    scene::Scene scene;
    scene.from_blender = true;
    const int mesh = add_triangles(scene, corners, add_diffuse(scene, glm::vec3(0.5F)));
    scene::MorphTarget bent;
    for (const glm::vec3& corner : corners) {
        const glm::vec3 c = glm::cos(corner * 1.5707963F);
        bent.positions.push_back(-0.3F * corner * (c.x * c.y + c.y * c.z + c.z * c.x));
    }
    scene.meshes[static_cast<size_t>(mesh)].primitives[0].targets = {bent};
    const int node = add_mesh_node(scene, mesh, rotated(20.0, {0.3, 1.0, 0.2}));
    scene.nodes[static_cast<size_t>(node)].weights = {0.0F};
    animate(scene, node, scene::Property::node_weights, {0.0F}, {1.0F});
    add_light(scene, light_of(scene::LightType::point), moved({0.1, 0.2, 0.1}));
    for (const double time : {0.0, 0.5, 1.0}) {
        const Traced result = trace(scene, traced(32, 3), time);
        for (size_t k = 0; k < 3; ++k) {
            // 1e-4 is rounding; two rays of 1,024 may leave where walls bend (avg_leak_test.cpp), and with
            // them their light.
            const double kept = result.flux_w(k).g / (100.0 * std::pow(0.5, static_cast<double>(k + 1)));
            EXPECT_LE(kept, 1.0 + 1e-4) << "bounce " << k + 1 << ", time " << time;
            EXPECT_GE(kept, 1.0 - 2.0 / 1024.0 - 1e-4) << "bounce " << k + 1 << ", time " << time;
        }
    }
}

TEST_F(AvgOfAScene, TheWorldsLightFillsAWhiteCorner) {
    // A white corner under a world of 1 shows 1 once all bounces are there (world_test.cpp), whatever these
    // are drawn from; of light that comes to it directly it shows 0.74 (the form factor of its wall).
    scene::Scene scene;
    scene.from_blender = true;
    scene.world = {glm::vec3(1.0F), 1.0F};
    const int square = add_square(scene, 2.0F, add_diffuse(scene));
    add_mesh_node(scene, square, moved({1.0, 0.0, 0.0}));
    add_mesh_node(scene, square, rotated(90.0, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}));
    CameraView camera = camera_from_above(1.0, 20.0);
    camera.world_from_camera = moved({0.7, 0.0, 0.0}) * camera.world_from_camera;
    Settings settings = bounced(32);
    settings.world_vpls = 256;
    settings.bounces = 4;
    settings.bounce_vpls = 1024;
    settings.bounce_source = BounceSource::avg;
    settings.show = Show::shaded;
    EXPECT_NEAR(draw(scene, camera, settings).mean(), 1.0, 0.03);
}

TEST_F(AvgOfAScene, ARoomThatEmitsSeesItself) {
    // A closed ball of radiance 1 and albedo 1/2: 1 + 1/2 + 1/4 + 1/8 with two bounces.
    scene::Scene scene;
    scene.from_blender = true;
    const int material = add_diffuse(scene, glm::vec3(0.5F));
    scene.materials.back().emission = glm::vec3(1.0F);
    add_mesh_node(scene, add_ball(scene, material, 1.0F), glm::dmat4(1.0));
    CameraView camera = camera_from_above(1.0, 0.5);
    camera.camera.far_m = 10.0F;
    Settings settings = bounced(32);
    settings.emitter_vpls = 1024;
    settings.bounces = 2;
    settings.bounce_vpls = 1024;
    settings.bounce_source = BounceSource::avg;
    settings.show = Show::shaded;
    EXPECT_NEAR(draw(scene, camera, settings).mean(), 1.875, 0.03 * 1.875);
}

}  // namespace
}  // namespace bounce::test
