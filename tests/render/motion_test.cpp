// SPDX-License-Identifier: Apache-2.0
//
// The layer that shows motion: where each pixel's point of surface was in the frame before, whatever moved
// it.
#include <optional>

#include <gmock/gmock.h>

#include "render_fixture.h"

namespace bounce::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Not;

constexpr int k_size = 64;
constexpr double k_px_a_m = 16.0;  // 4 m wide
// Pixels: positions are floats of a scene one unit large, 64 pixels wide.
constexpr double k_tolerance_px = 1e-3;

glm::dmat4 at(double x, double y, double z) {
    return glm::translate(glm::dmat4(1.0), {x, y, z});
}

class Motion : public ::testing::Test {
  protected:
    void SetUp() override {
        require_context();
        scene_.from_blender = true;
        floor_ = add_mesh_node(scene_, add_square(scene_, 8.0F, add_diffuse(scene_)), glm::dmat4(1.0));
    }

    // Poses the scene as it is for the frame before; what follows is of the frame now.
    void next_frame() { before_ = scene::evaluate_pose(scene_, 0.0); }

    Rendered show(const CameraView& camera, const CameraView& camera_before) {
        Renderer renderer(scene_);
        Settings settings;
        settings.width = settings.height = k_size;
        settings.show = Show::motion;
        const scene::Pose now = scene::evaluate_pose(scene_, 0.0);
        const Moment before{before_, camera_before};
        Rendered out;
        out.report = renderer.render(now, camera, settings, gl::TimingMode::off, &before);
        out.image = renderer.read_color();
        for (const float value : out.image.rgb) {
            EXPECT_TRUE(std::isfinite(value));
        }
        return out;
    }
    Rendered show() { return show(camera_from_above(4.0, 10.0), camera_from_above(4.0, 10.0)); }

    static void expect_motion(const Rendered& out, int x, int y, const glm::dvec3& expected) {
        const glm::dvec3 found = out.at(x, y);
        EXPECT_NEAR(found.x, expected.x, k_tolerance_px) << "at " << x << " " << y;
        EXPECT_NEAR(found.y, expected.y, k_tolerance_px) << "at " << x << " " << y;
        EXPECT_NEAR(found.z, expected.z, 1e-4 * expected.z) << "at " << x << " " << y;
    }
    static void expect_unseen(const Rendered& out, int x, int y) {
        EXPECT_EQ(out.at(x, y).z, 0.0) << "at " << x << " " << y;
    }

    scene::Node& node(int index) { return scene_.nodes[static_cast<size_t>(index)]; }
    scene::Primitive& primitive(int mesh) { return scene_.meshes[static_cast<size_t>(mesh)].primitives[0]; }

    scene::Scene scene_;
    scene::Pose before_;
    int floor_ = 0;
};

CameraView slanted_camera() {
    CameraView view;
    view.world_from_camera = glm::inverse(
        glm::lookAt(glm::dvec3(1.3, -2.1, 2.7), glm::dvec3(0.1, 0.2, 0.0), glm::dvec3(0.0, 0.0, 1.0)));
    view.camera.perspective = true;
    view.camera.yfov_rad = 0.7F;
    view.camera.near_m = 0.1F;
    view.camera.far_m = 100.0F;
    return view;
}

TEST_F(Motion, WhatStandsStillDoesNotMoveAtAll) {
    add_mesh_node(scene_, add_square(scene_, 1.0F, add_diffuse(scene_)),
                  at(0.0, 0.0, 0.5) * glm::rotate(glm::dmat4(1.0), 0.7, glm::dvec3(1.0, 2.0, 0.0)));
    next_frame();
    const Rendered out = show(slanted_camera(), slanted_camera());
    for (size_t i = 0; i < out.image.rgb.size(); i += 3) {
        // To the bit: what is compared with itself must be the same pixel. The floor fills the picture.
        ASSERT_EQ(out.image.rgb[i], 0.0F) << i;
        ASSERT_EQ(out.image.rgb[i + 1], 0.0F) << i;
        ASSERT_GT(out.image.rgb[i + 2], 0.0F) << i;
    }
}

TEST_F(Motion, TheCameraMoves) {
    next_frame();
    CameraView now = camera_from_above(4.0, 10.0);
    now.world_from_camera = at(0.25, 0.125, 10.0);
    const Rendered out = show(now, camera_from_above(4.0, 10.0));
    // Right and up: everything was 4 pixels farther right and 2 farther up, 10 m below.
    expect_motion(out, 32, 32, {4.0, -2.0, 10.0});
    expect_motion(out, 59, 5, {4.0, -2.0, 10.0});
    expect_unseen(out, 60, 30);  // left the picture on the right
    expect_unseen(out, 30, 1);   // and above
}

TEST_F(Motion, APerspectiveCameraComesCloser) {
    next_frame();
    CameraView camera = slanted_camera();
    camera.world_from_camera = at(0.0, 0.0, 4.0);
    CameraView before = camera;
    before.world_from_camera = at(0.0, 0.0, 5.0);
    const Rendered out = show(camera, before);
    // From the middle, at 32, to a pixel's middle the way was 4/5 as long.
    for (const int x : {3, 31, 50}) {
        expect_motion(out, x, 40, {-0.2 * (x + 0.5 - 32.0), -0.2 * (40.5 - 32.0), 5.0});
    }
}

TEST_F(Motion, AnObjectMovesAndUncoversTheFloor) {
    const int square =
        add_mesh_node(scene_, add_square(scene_, 0.5F, add_diffuse(scene_)), at(-0.5, 0.0, 1.0));
    next_frame();
    node(square).matrix = at(0.5, 0.25, 1.0);
    const Rendered out = show();
    expect_motion(out, 40, 28, {-16.0, 4.0, 9.0});  // on the square
    expect_motion(out, 10, 32, {0.0, 0.0, 10.0});   // on the floor
    expect_unseen(out, 24, 32);                     // where it stood, the floor was hidden
    expect_motion(out, 40, 50, {0.0, 0.0, 10.0});
}

TEST_F(Motion, WhatTurnsAndShrinksFollowsItsSurface) {
    const int square =
        add_mesh_node(scene_, add_square(scene_, 3.0F, add_diffuse(scene_)), at(0.0, 0.0, 1.0));
    next_frame();
    node(square).matrix = at(0.0, 0.0, 1.0) *
                          glm::rotate(glm::dmat4(1.0), 0.5 * pi, glm::dvec3(0.0, 0.0, 1.0)) *
                          glm::scale(glm::dmat4(1.0), glm::dvec3(0.5));
    const Rendered out = show();
    // The point 8.5 pixels right of the middle and 0.5 below was twice as far away and a quarter turn back:
    // 1 pixel left of it and 17 below.
    expect_motion(out, 40, 32, {-1.0 - 8.5, 17.0 - 0.5, 9.0});
}

// One joint holds the whole square; the mesh's own node does not count.
TEST_F(Motion, AJointMoves) {
    const int mesh = add_square(scene_, 1.0F, add_diffuse(scene_));
    primitive(mesh).joints.assign(4, glm::u16vec4(0));
    primitive(mesh).weights.assign(4, glm::vec4(1.0F, 0.0F, 0.0F, 0.0F));
    scene::Node joint;
    joint.matrix = at(-0.5, 0.0, 1.0);
    scene::Skin skin;
    skin.joints = {add_node(scene_, joint)};
    skin.joint_from_mesh.assign(1, glm::mat4(1.0F));
    scene_.skins.push_back(skin);
    const int skinned = add_mesh_node(scene_, mesh, at(9.0, 9.0, 9.0));
    node(skinned).skin = 0;
    next_frame();
    node(skin.joints[0]).matrix = at(0.25, 0.0, 1.5);
    const Rendered out = show();
    expect_motion(out, 36, 32, {-0.75 * k_px_a_m, 0.0, 9.0});
    expect_motion(out, 60, 32, {0.0, 0.0, 10.0});
    EXPECT_THAT(out.report.executed, ElementsAre("previous deform", "previous depth", "deform", "motion"));
}

TEST_F(Motion, AMeshMorphs) {
    const int mesh = add_square(scene_, 1.0F, add_diffuse(scene_));
    scene::MorphTarget aside;
    aside.positions.assign(4, glm::vec3(1.0F, 0.0F, 0.0F));
    primitive(mesh).targets = {aside};
    const int morphing = add_mesh_node(scene_, mesh, at(-0.5, 0.0, 1.0));
    node(morphing).weights = {0.25F};
    next_frame();
    node(morphing).weights = {0.75F};
    node(morphing).matrix = at(-0.5, -0.25, 1.0);  // and its node moves as well
    const Rendered out = show();
    expect_motion(out, 36, 36, {-0.5 * k_px_a_m, -0.25 * k_px_a_m, 9.0});
}

TEST_F(Motion, InstancesOfANodeAreFollowedEach) {
    const int many = add_mesh_node(scene_, add_square(scene_, 0.5F, add_diffuse(scene_)), glm::dmat4(1.0));
    node(many).instances = {at(-1.0, 0.0, 1.0), at(1.0, 0.0, 1.0)};
    next_frame();
    node(many).instances = {at(-1.0, 0.5, 1.0), at(1.0, -0.5, 1.0)};
    const Rendered out = show();
    expect_motion(out, 16, 24, {0.0, 8.0, 9.0});
    expect_motion(out, 48, 40, {0.0, -8.0, 9.0});
}

TEST_F(Motion, WhatWasNotThereIsUnseen) {
    const int square =
        add_mesh_node(scene_, add_square(scene_, 0.5F, add_diffuse(scene_)), at(0.0, 0.0, 1.0));
    next_frame();
    std::erase_if(before_.draws, [&](const scene::DrawInstance& draw) { return draw.node == square; });
    const Rendered out = show();
    expect_unseen(out, 32, 32);
    expect_motion(out, 10, 32, {0.0, 0.0, 10.0});
}

TEST_F(Motion, WhatWasBehindTheCameraIsUnseen) {
    next_frame();
    CameraView camera = slanted_camera();
    camera.world_from_camera = at(0.0, 0.0, 4.0);
    CameraView before = camera;
    before.world_from_camera = at(0.0, 0.0, -4.0);
    const Rendered out = show(camera, before);
    EXPECT_EQ(out.mean(), 0.0);
}

// A slanted plane's depth changes from pixel to pixel by more than the tolerance: it is the same surface all
// the same, and what stands a little before it is not.
TEST_F(Motion, DepthIsComparedOnTheSurfacesPlane) {
    node(floor_).matrix = glm::rotate(glm::dmat4(1.0), 1.4, glm::dvec3(1.0, 0.0, 0.0));
    next_frame();
    CameraView now = camera_from_above(1.0, 10.0);
    now.world_from_camera = at(0.003, 0.002, 10.0);
    const Rendered out = show(now, camera_from_above(1.0, 10.0));
    int seen = 0;
    for (int y = 2; y < k_size - 2; ++y) {
        for (int x = 2; x < k_size - 2; ++x) {
            seen += out.at(x, y).z > 0.0 ? 1 : 0;
        }
    }
    EXPECT_EQ(seen, (k_size - 4) * (k_size - 4));
}

TEST_F(Motion, OnlyThisLayerPaysForIt) {
    next_frame();
    EXPECT_THAT(show().report.executed, ElementsAre("previous depth", "motion"));
    Settings settings;
    settings.width = settings.height = k_size;
    const Rendered shaded = draw(scene_, camera_from_above(4.0, 10.0), settings);
    EXPECT_THAT(shaded.report.executed, Not(Contains("motion")));
    EXPECT_THAT(shaded.report.executed, Not(Contains("previous depth")));
}

}  // namespace
}  // namespace bounce::test
