// SPDX-License-Identifier: Apache-2.0
//
// What preset auto sees of a scene. No OpenGL.
#include "renderer/auto_scene.h"

#include <gtest/gtest.h>

namespace bounce {
namespace {

// Corners of a floor and a wall, 2 x 2 m each, 100 m apart along X, under a sun that shines on both alike;
// and a camera that sees nothing but the first.
class AutoSceneTest : public testing::Test {
  protected:
    void SetUp() override {
        scene::Material white;
        white.metallic = 0.0F;
        scene_.materials = {white};
        scene::Primitive corner;
        corner.positions = {{-1, 0, 2}, {1, 0, 2}, {1, 0, 0}, {-1, 0, 0}, {-1, 2, 0}, {1, 2, 0}};
        corner.normals.assign(6, {0, 1, 0});
        corner.indices = {0, 1, 2, 0, 2, 3, 3, 2, 5, 3, 5, 4};
        corner.material = 0;
        scene_.meshes = {{"corner", {corner}, {}}};
        scene::Light sun;
        sun.type = scene::LightType::sun;
        sun.irradiance_w_m2 = 1.0F;
        scene_.lights = {sun};
        scene::Node node;
        // Looks along (0, -1, -1).
        node.local.rotation = glm::angleAxis(-0.7853981633974483, glm::dvec3(1, 0, 0));
        node.light = 0;
        add(node);
        scene_.cameras = {scene::Camera{}};
        node.light = scene::k_none;
        node.camera = 0;
        node.local.translation = {0, 5, 5};
        add(node);
        scene_.active_camera_node = 1;
        add_corner(0.0);
    }
    void add_corner(double x) {
        scene::Node node;
        node.mesh = 0;
        node.local.translation = {x, 0, 0};
        add(node);
    }
    void add(const scene::Node& node) {
        scene_.topological_order.push_back(static_cast<int>(scene_.nodes.size()));
        scene_.roots.push_back(static_cast<int>(scene_.nodes.size()));
        scene_.nodes.push_back(node);
    }
    [[nodiscard]] AutoScene describe() const {
        return describe_scene(scene_, scene::k_all_animations, "", 64, 64);
    }
    scene::Scene scene_;
};

// What light falls on the others shows nothing where the camera looks.
TEST_F(AutoSceneTest, LightElsewhereDoesNotCount) {
    const double one = describe().seen_share;
    EXPECT_GT(one, 0.3);
    EXPECT_LE(one, 1.0);
    for (const double x : {100.0, 200.0, 300.0}) {
        add_corner(x);
    }
    // A quarter, but for the bound on what is near, which grows with the area, and for fewer places in each.
    EXPECT_NEAR(describe().seen_share / one, 0.25, 0.05);
}

TEST_F(AutoSceneTest, LightCountsWhereItFalls) {
    const double one = describe().seen_share;
    add_corner(100.0);
    EXPECT_LT(describe().seen_share, 0.7 * one);
    scene_.lights[0].type = scene::LightType::spot;
    scene_.lights[0].power_w = 10.0F;
    scene_.lights[0].cone_angle_rad = 0.8F;
    scene_.nodes[0].local.translation = {0, 5, 5};
    EXPECT_GT(describe().seen_share, 0.7 * one) << "nothing falls on the other";
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
    scene_.nodes[2].visible = false;
    const AutoScene nothing = describe();
    EXPECT_EQ(nothing.seen_share, 1.0);
    scene_ = {};
    EXPECT_EQ(describe().lights(), 0);
}

}  // namespace
}  // namespace bounce
