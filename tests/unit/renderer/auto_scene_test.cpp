// SPDX-License-Identifier: Apache-2.0
//
// What preset auto sees of a scene. No OpenGL.
#include "renderer/auto_scene.h"

#include <gtest/gtest.h>

namespace bounce {
namespace {

// A floor of 10 x 10 m under a sun, and a camera above its middle that looks straight down on a square of
// 5 x 5 m.
class AutoSceneTest : public testing::Test {
  protected:
    void SetUp() override {
        scene::Material white;
        white.metallic = 0.0F;
        scene_.materials = {white};
        scene::Primitive floor;
        floor.positions = {{-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5}};
        floor.normals.assign(4, {0, 1, 0});
        floor.indices = {0, 1, 2, 0, 2, 3};
        floor.material = 0;
        scene_.meshes = {{"floor", {floor}, {}}};
        scene::Node node;
        node.mesh = 0;
        add(node);
        scene::Light sun;
        sun.type = scene::LightType::sun;
        sun.irradiance_w_m2 = 1.0F;
        scene_.lights = {sun};
        scene::Node down;
        // -Z becomes -Y.
        down.local.rotation = glm::angleAxis(-1.5707963267948966, glm::dvec3(1, 0, 0));
        down.light = 0;
        add(down);
        scene::Camera camera;
        camera.yfov_rad = 2.0F * 0.4636476F;  // whose tangent is 0.5, at 5 m 2.5 m
        scene_.cameras = {camera};
        down.light = scene::k_none;
        down.camera = 0;
        down.local.translation = {0, 5, 0};
        add(down);
        scene_.active_camera_node = 2;
    }
    void add(const scene::Node& node) {
        scene_.topological_order.push_back(static_cast<int>(scene_.nodes.size()));
        scene_.roots.push_back(static_cast<int>(scene_.nodes.size()));
        scene_.nodes.push_back(node);
    }
    [[nodiscard]] AutoScene describe() const { return describe_scene(scene_, scene::k_all_animations, "", 64, 64); }
    scene::Scene scene_;
};

TEST_F(AutoSceneTest, TheCameraSeesAQuarterOfASunlitFloor) {
    // Of 8,192 places, spread more evenly than at random: the standard deviation of random ones is 0.005.
    EXPECT_NEAR(describe().seen_share, 0.25, 0.01);
}

TEST_F(AutoSceneTest, LightCountsWhereItFalls) {
    scene_.lights[0].type = scene::LightType::spot;
    scene_.lights[0].power_w = 10.0F;
    scene_.lights[0].cone_angle_rad = 0.6F;
    scene_.nodes[1].local.translation = {0, 5, 0};
    EXPECT_NEAR(describe().seen_share, 1.0, 1e-9) << "its cone ends within the frame";
    scene_.nodes[1].local.translation = {4, 3, 4};
    EXPECT_NEAR(describe().seen_share, 0.0, 1e-9) << "it shines beside it";
}

TEST_F(AutoSceneTest, CountsLights) {
    EXPECT_EQ(describe().planar_lights, 1);
    EXPECT_EQ(describe().sized_planar, 0);
    EXPECT_TRUE(describe().lit());
    scene_.lights[0].angle_rad = 0.1F;
    EXPECT_EQ(describe().sized_planar, 1);
    scene_.lights[0].irradiance_w_m2 = 0.0F;
    EXPECT_EQ(describe().lights(), 0);
    EXPECT_FALSE(describe().lit());
    EXPECT_EQ(describe().seen_share, 1.0) << "there is nothing to see a share of";
    scene_.lights[0].type = scene::LightType::area;
    scene_.lights[0].power_w = 5.0F;
    scene_.lights[0].size_x_m = scene_.lights[0].size_y_m = 1.0F;
    EXPECT_EQ(describe().cube_lights, 1);
    EXPECT_EQ(describe().sized_cube, 1);
}

TEST_F(AutoSceneTest, ASceneOfNothing) {
    scene_.nodes[0].visible = false;
    const AutoScene nothing = describe();
    EXPECT_EQ(nothing.seen_share, 1.0);
    scene_ = {};
    EXPECT_EQ(describe().lights(), 0);
}

}  // namespace
}  // namespace bounce
