// SPDX-License-Identifier: Apache-2.0
//
// Where a point of the world lands in the picture, against figures worked out by hand.
#include "renderer/camera_view.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace bounce {
namespace {

constexpr double pi = std::numbers::pi;

// Normalised device coordinates of a world point.
glm::dvec3 project(const CameraView& view, int width, int height, const glm::dvec3& world,
                   const gpu::RenderSpace& space = {}) {
    const glm::dvec4 p =
        camera_matrices(view, width, height, space).clip_from_render * glm::dvec4(space.point(world), 1.0);
    return glm::dvec3(p) / p.w;
}

// The place in the picture, -1 to 1, y up.
void expect_near(const glm::dvec3& projected, const glm::dvec2& place, double tolerance = 1e-6) {
    EXPECT_NEAR(projected.x, place.x, tolerance);
    EXPECT_NEAR(projected.y, place.y, tolerance);
}

// At the origin, looking along -Z, near 0.5 m and far 10 m.
CameraView perspective(double yfov) {
    CameraView view;
    view.camera.yfov_rad = static_cast<float>(yfov);
    view.camera.near_m = 0.5F;
    view.camera.far_m = 10.0F;
    return view;
}

// Blender's default lens: 36 mm wide, 50 mm long; 24 mm high.
CameraView blender(scene::SensorFit fit) {
    CameraView view = perspective(1.0);
    view.camera.sensor = scene::Sensor{};
    view.camera.sensor->fit = fit;
    return view;
}

TEST(CameraView, DepthIsOneAtTheNearPlaneAndZeroAtTheFarOne) {
    const CameraView view = perspective(1.0);
    EXPECT_NEAR(project(view, 100, 50, {0, 0, -0.5}).z, 1.0, 1e-9);
    EXPECT_NEAR(project(view, 100, 50, {0, 0, -10.0}).z, 0.0, 1e-9);
    // 1/z is linear between: at 1 m, (1/1 - 1/10) / (1/0.5 - 1/10).
    EXPECT_NEAR(project(view, 100, 50, {0, 0, -1.0}).z, 0.9 / 1.9, 1e-9);
}

TEST(CameraView, InfiniteFarPlaneReachesZeroAtInfinity) {
    CameraView view = perspective(1.0);
    view.camera.far_m = std::numeric_limits<float>::infinity();
    EXPECT_NEAR(project(view, 100, 50, {0, 0, -0.5}).z, 1.0, 1e-9);
    EXPECT_NEAR(project(view, 100, 50, {0, 0, -50.0}).z, 0.01, 1e-9);
    EXPECT_GT(project(view, 100, 50, {0, 0, -1e9}).z, 0.0);
}

TEST(CameraView, AFarPlaneBeforeTheNearOneIsTakenAsInfinity) {
    CameraView view = perspective(1.0);
    view.camera.far_m = 0.1F;
    EXPECT_NEAR(project(view, 100, 50, {0, 0, -50.0}).z, 0.01, 1e-9);
}

TEST(CameraView, OrthographicDepthIsLinear) {
    CameraView view = perspective(1.0);
    view.camera.perspective = false;
    view.camera.xmag = view.camera.ymag = 2.0F;
    EXPECT_NEAR(project(view, 100, 100, {0, 0, -0.5}).z, 1.0, 1e-9);
    EXPECT_NEAR(project(view, 100, 100, {0, 0, -5.25}).z, 0.5, 1e-9);
    EXPECT_NEAR(project(view, 100, 100, {0, 0, -10.0}).z, 0.0, 1e-9);
    expect_near(project(view, 100, 100, {1.0, -2.0, -3.0}), {0.5, -1.0});
    // ymag is half the height; the width follows the picture.
    expect_near(project(view, 200, 100, {4.0, 2.0, -3.0}), {1.0, 1.0});
}

TEST(CameraView, YfovFillsTheHeight) {
    // 90 degrees: half the height is the distance.
    const CameraView view = perspective(pi / 2.0);
    expect_near(project(view, 200, 100, {0.0, 3.0, -3.0}), {0.0, 1.0});
    expect_near(project(view, 200, 100, {6.0, 0.0, -3.0}), {1.0, 0.0});
    expect_near(project(view, 100, 200, {1.5, 1.5, -3.0}), {1.0, 0.5});
}

TEST(CameraView, WidePixelsSeeAWiderFrame) {
    CameraView view = perspective(pi / 2.0);
    view.pixel_aspect = 2.0;
    expect_near(project(view, 100, 100, {6.0, 3.0, -3.0}), {1.0, 1.0});
}

// The frame of Blender's default lens on the plane at 5 m: 5 * 36 / 50 = 3.6 m across the fitted side.
struct FitCase {
    const char* name;
    scene::SensorFit fit;
    int width, height;
    double half_width, half_height;  // metres at 5 m
};

class BlenderFit : public testing::TestWithParam<FitCase> {};

TEST_P(BlenderFit, FrameAtFiveMetres) {
    const FitCase& c = GetParam();
    const CameraView view = blender(c.fit);
    expect_near(project(view, c.width, c.height, {c.half_width, c.half_height, -5.0}), {1.0, 1.0}, 1e-5);
    expect_near(project(view, c.width, c.height, {-c.half_width, 0.0, -5.0}), {-1.0, 0.0}, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(
    CameraView, BlenderFit,
    testing::Values(FitCase{"AutoLandscape", scene::SensorFit::automatic, 200, 100, 1.8, 0.9},
                    // Automatic fit in portrait still takes the sensor's width, along the height.
                    FitCase{"AutoPortrait", scene::SensorFit::automatic, 100, 200, 0.9, 1.8},
                    FitCase{"AutoSquare", scene::SensorFit::automatic, 100, 100, 1.8, 1.8},
                    FitCase{"HorizontalLandscape", scene::SensorFit::horizontal, 200, 100, 1.8, 0.9},
                    FitCase{"HorizontalPortrait", scene::SensorFit::horizontal, 100, 200, 1.8, 3.6},
                    // 5 * 24 / 50 = 2.4 m high.
                    FitCase{"VerticalLandscape", scene::SensorFit::vertical, 200, 100, 2.4, 1.2},
                    FitCase{"VerticalPortrait", scene::SensorFit::vertical, 100, 200, 0.6, 1.2}),
    [](const auto& name_of) { return name_of.param.name; });

TEST(CameraView, BlenderShiftCountsInTheFittedSide) {
    CameraView view = blender(scene::SensorFit::automatic);
    view.camera.sensor->shift_x = 0.25F;
    view.camera.sensor->shift_y = -0.5F;
    // 200 x 100: the frame is 3.6 m wide, so its middle moves by 0.9 m to the right and 1.8 m down.
    expect_near(project(view, 200, 100, {0.9, -1.8, -5.0}), {0.0, 0.0});
    // 100 x 200: the fitted side is the height, 3.6 m: the same metres.
    expect_near(project(view, 100, 200, {0.9, -1.8, -5.0}), {0.0, 0.0});
    expect_near(project(view, 100, 200, {1.8, 0.0, -5.0}), {1.0, 1.0});
}

TEST(CameraView, BlenderPixelAspectDecidesTheFit) {
    // 100 x 150 pixels, each twice as wide as high: the picture is 100 x 75 in pixel widths, a landscape.
    CameraView view = blender(scene::SensorFit::automatic);
    view.pixel_aspect = 2.0;
    expect_near(project(view, 100, 150, {1.8, 1.35, -5.0}), {1.0, 1.0}, 1e-5);
    // Half as wide as high: 100 x 200, a portrait.
    view.pixel_aspect = 0.5;
    expect_near(project(view, 100, 100, {0.9, 1.8, -5.0}), {1.0, 1.0}, 1e-5);
}

TEST(CameraView, BlenderOrthographicScaleIsTheFittedSide) {
    CameraView view = blender(scene::SensorFit::automatic);
    view.camera.perspective = false;
    view.camera.sensor->ortho_scale = 8.0F;
    expect_near(project(view, 200, 100, {4.0, 2.0, -5.0}), {1.0, 1.0});
    expect_near(project(view, 100, 200, {2.0, 4.0, -5.0}), {1.0, 1.0});
    view.camera.sensor->shift_x = 0.25F;
    expect_near(project(view, 200, 100, {2.0, 0.0, -5.0}), {0.0, 0.0});
}

TEST(CameraView, AScaledCameraNodeSeesTheSamePictureAndAMirroredOneItsMirrorImage) {
    // Scale of a camera's node is ignored, but for its sign.
    const CameraView plain = perspective(1.0);
    CameraView scaled = plain;
    scaled.world_from_camera = glm::scale(glm::dmat4(1.0), glm::dvec3(3.0, 0.2, 7.0));
    const glm::dvec3 point(0.3, -0.4, -2.0);
    expect_near(project(scaled, 160, 90, point), glm::dvec2(project(plain, 160, 90, point)), 1e-9);
    EXPECT_NEAR(project(scaled, 160, 90, point).z, project(plain, 160, 90, point).z, 1e-9);
    // Below a mirrored parent the picture is mirrored, as Cycles draws it.
    scaled.world_from_camera = glm::scale(glm::dmat4(1.0), glm::dvec3(-1.0, 1.0, 1.0));
    expect_near(project(scaled, 160, 90, point),
                glm::dvec2(-1.0, 1.0) * glm::dvec2(project(plain, 160, 90, point)), 1e-9);
}

TEST(CameraView, AnOffsetMovesTheFrameByPixels) {
    for (const bool is_perspective : {true, false}) {
        CameraView view = blender(scene::SensorFit::automatic);
        view.camera.perspective = is_perspective;
        view.camera.sensor->ortho_scale = 8.0F;
        view.pixel_aspect = 1.5;
        const glm::dvec3 point(0.3, -0.4, -2.0);
        const glm::dvec2 before(project(view, 160, 90, point));
        // Pixels look a quarter to the right and three quarters up, so what is seen goes the other way.
        view.offset_px = {0.25, 0.75};
        expect_near(project(view, 160, 90, point), before - glm::dvec2(2 * 0.25 / 160, 2 * 0.75 / 90), 1e-12);
    }
}

TEST(CameraView, RenderSpaceDoesNotMoveThePicture) {
    // 10^6 units away, the scene three kilometres large.
    CameraView view = perspective(0.8);
    const glm::dvec3 far_away(1e6, -2e6, 3e6);
    view.world_from_camera = glm::rotate(glm::translate(glm::dmat4(1.0), far_away), 0.7,
                                         glm::normalize(glm::dvec3(1.0, 2.0, 0.5)));
    const gpu::RenderSpace space{far_away + glm::dvec3(100.0), 1.0 / 3000.0};
    const glm::dvec3 point =
        far_away + glm::dvec3(glm::dmat3(view.world_from_camera) * glm::dvec3(0.3, -0.4, -2.0));
    const glm::dvec3 near_origin = project(perspective(0.8), 160, 90, {0.3, -0.4, -2.0});
    expect_near(project(view, 160, 90, point, space), glm::dvec2(near_origin), 1e-7);
    EXPECT_NEAR(project(view, 160, 90, point, space).z, near_origin.z, 1e-7);
}

TEST(CameraView, OrthographicInRenderSpace) {
    CameraView view = perspective(1.0);
    view.camera.perspective = false;
    view.camera.ymag = 2.0F;
    const gpu::RenderSpace space{{5.0, 6.0, 7.0}, 0.01};
    expect_near(project(view, 100, 100, {1.0, -2.0, -3.0}, space), {0.5, -1.0});
    EXPECT_NEAR(project(view, 100, 100, {0.0, 0.0, -5.25}, space).z, 0.5, 1e-6);
}

TEST(CameraView, InverseAndDescriptionAgreeWithTheMatrix) {
    CameraView view = blender(scene::SensorFit::automatic);
    view.world_from_camera =
        glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(1, 2, 3)), 0.9, glm::dvec3(0, 1, 0));
    const gpu::RenderSpace space{{0.5, 0.5, 0.5}, 0.1};
    const CameraMatrices m = camera_matrices(view, 160, 90, space);
    const glm::dmat4 identity = m.clip_from_render * m.render_from_clip;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            EXPECT_NEAR(identity[column][row], column == row ? 1.0 : 0.0, 1e-9);
        }
    }
    EXPECT_LT(glm::length(m.position - space.point({1, 2, 3})), 1e-12);
    EXPECT_LT(glm::length(m.forward - glm::dvec3(-std::sin(0.9), 0.0, -std::cos(0.9))), 1e-12);
    EXPECT_TRUE(m.perspective);
    // Half a pixel's height at distance 1: the frame is 36/50 * 90/160 high.
    EXPECT_NEAR(m.pixel_radius, 0.5 * 36.0 / 50.0 / 160.0, 1e-9);
}

TEST(CameraView, APixelOfAnOrthographicPictureIsARenderSpaceLength) {
    CameraView view = perspective(1.0);
    view.camera.perspective = false;
    view.camera.ymag = 2.0F;
    EXPECT_NEAR(camera_matrices(view, 100, 100, {{0, 0, 0}, 0.01}).pixel_radius, 0.5 * 4.0 / 100.0 * 0.01,
                1e-12);
}

}  // namespace
}  // namespace bounce
