// SPDX-License-Identifier: Apache-2.0
#include "viewer/camera_controls.h"

#include <cmath>
#include <vector>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace bounce::viewer {
namespace {

constexpr int k_width = 800;
constexpr int k_height = 600;
constexpr double k_tolerance = 1e-9;

scene::Bounds cube(const glm::dvec3& center, double half) {
    scene::Bounds bounds;
    bounds.grow(center - glm::dvec3(half));
    bounds.grow(center + glm::dvec3(half));
    return bounds;
}

CameraView looking(const glm::dvec3& from, const glm::dvec3& at, const glm::dvec3& up = {0.0, 1.0, 0.0}) {
    CameraView view;
    view.world_from_camera = glm::inverse(glm::lookAt(from, at, up));
    return view;
}

glm::dvec3 eye(const CameraControls& controls) {
    return glm::dvec3(controls.view().world_from_camera[3]);
}

// Where a point appears, in heights of the picture from its middle, right and down positive.
glm::dvec2 on_screen(const CameraView& view, const glm::dvec3& point) {
    const CameraMatrices matrices = camera_matrices(view, k_width, k_height, gpu::RenderSpace{});
    const glm::dvec4 clip = matrices.clip_from_render * glm::dvec4(point, 1.0);
    return {0.5 * clip.x / clip.w * k_width / k_height, -0.5 * clip.y / clip.w};
}

double largest_difference(const glm::dmat4& a, const glm::dmat4& b) {
    double largest = 0.0;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            largest = std::max(largest, std::abs(a[column][row] - b[column][row]));
        }
    }
    return largest;
}

TEST(CameraControls, StartsAsTheViewThatItIsGiven) {
    const std::vector<CameraView> views = {
        looking({3.0, 2.0, 5.0}, {0.0, 0.0, 0.0}),
        looking({-3.0, -7.0, 0.1}, {1.0, 2.0, 3.0}),
        looking({1.0, 1.0, 4.0}, {0.0, 0.0, 0.0}, {0.4, 1.0, 0.2}),  // rolled
        looking({0.0, 9.0, 0.0}, {0.0, 0.0, 0.0}, {0.3, 0.0, 1.0}),  // straight down
        looking({0.0, -9.0, 0.0}, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.2}),
    };
    for (const CameraView& view : views) {
        const CameraControls controls(view, cube({0.0, 0.0, 0.0}, 1.0));
        EXPECT_LT(largest_difference(controls.view().world_from_camera, view.world_from_camera), k_tolerance);
    }
}

TEST(CameraControls, PivotIsThePointOfTheAxisNearestTheCentre) {
    // The axis runs along -Z at x = 2; the centre is at (0, 0, -3).
    const CameraControls controls(looking({2.0, 0.0, 10.0}, {2.0, 0.0, 0.0}), cube({0.0, 0.0, -3.0}, 1.0));
    EXPECT_NEAR(glm::distance(controls.pivot(), glm::dvec3(2.0, 0.0, -3.0)), 0.0, k_tolerance);
    EXPECT_NEAR(controls.distance(), 13.0, k_tolerance);
}

TEST(CameraControls, PivotStaysInFrontWhereTheCentreIsBehind) {
    const CameraControls controls(looking({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}), cube({0.0, 0.0, 5.0}, 1.0));
    EXPECT_GT(controls.distance(), 0.0);
    EXPECT_LT(controls.pivot().z, 0.0);
}

TEST(CameraControls, OrbitKeepsThePivotInTheMiddleAndItsDistance) {
    CameraControls controls(looking({3.0, 2.0, 5.0}, {0.0, 0.0, 0.0}), cube({0.0, 0.0, 0.0}, 1.0));
    const double distance = controls.distance();
    controls.orbit(0.2, -0.1);
    EXPECT_NEAR(glm::distance(eye(controls), controls.pivot()), distance, k_tolerance);
    EXPECT_LT(glm::length(on_screen(controls.view(), controls.pivot())), 1e-6);
}

TEST(CameraControls, DraggingRightTurnsTheSceneRight) {
    CameraControls controls(looking({0.0, 0.0, 10.0}, {0.0, 0.0, 0.0}), cube({0.0, 0.0, 0.0}, 1.0));
    const glm::dvec3 near_side(0.0, 0.0, 1.0);
    controls.orbit(0.05, 0.0);
    EXPECT_GT(on_screen(controls.view(), near_side).x, 0.01);
    controls.orbit(-0.05, 0.05);
    EXPECT_GT(on_screen(controls.view(), near_side).y, 0.01);
}

TEST(CameraControls, OrbitStopsAtTheZenith) {
    CameraControls controls(looking({0.0, 0.0, 10.0}, {0.0, 0.0, 0.0}), cube({0.0, 0.0, 0.0}, 1.0));
    controls.orbit(0.0, 5.0);
    EXPECT_NEAR(eye(controls).y, 10.0, 1e-6);
    // Not flipped over: what was the front is at the picture's lower edge still.
    EXPECT_GT(on_screen(controls.view(), {0.0, 0.0, 1.0}).y, 0.0);
}

TEST(CameraControls, AHorizontalHorizonStaysHorizontal) {
    CameraControls controls(looking({3.0, 2.0, 5.0}, {0.0, 0.0, 0.0}), cube({0.0, 0.0, 0.0}, 1.0));
    for (int i = 0; i < 1000; ++i) {
        controls.orbit(0.013, 0.007 * std::sin(i));
    }
    EXPECT_NEAR(controls.view().world_from_camera[0].y, 0.0, k_tolerance);
}

TEST(CameraControls, PanMovesThePivotsPlaneWithTheMouse) {
    for (const bool perspective : {true, false}) {
        CameraView view = looking({3.0, 2.0, 5.0}, {0.0, 0.0, 0.0});
        view.camera.perspective = perspective;
        CameraControls controls(view, cube({0.0, 0.0, 0.0}, 1.0));
        const glm::dvec3 pivot = controls.pivot();
        controls.pan(0.2, -0.1, k_width, k_height);
        const glm::dvec2 moved = on_screen(controls.view(), pivot);
        EXPECT_NEAR(moved.x, 0.2, 1e-6);
        EXPECT_NEAR(moved.y, -0.1, 1e-6);
    }
}

TEST(CameraControls, ZoomGoesNearerAndBack) {
    CameraControls controls(looking({3.0, 2.0, 5.0}, {0.0, 0.0, 0.0}), cube({0.0, 0.0, 0.0}, 1.0));
    const glm::dvec3 before = eye(controls);
    controls.zoom(3.0);
    EXPECT_LT(glm::length(eye(controls)), glm::length(before));
    controls.zoom(-3.0);
    EXPECT_LT(glm::distance(eye(controls), before), k_tolerance);
}

TEST(CameraControls, ZoomChangesAnOrthographicScale) {
    CameraView view = looking({0.0, 0.0, 10.0}, {0.0, 0.0, 0.0});
    view.camera.perspective = false;
    view.camera.ymag = 4.0F;
    CameraControls controls(view, cube({0.0, 0.0, 0.0}, 1.0));
    controls.zoom(1.0);
    EXPECT_FLOAT_EQ(controls.view().camera.ymag, 3.6F);
    EXPECT_NEAR(eye(controls).z, 10.0, k_tolerance);
}

TEST(CameraControls, NoZoomReachesThePivotOrLosesIt) {
    CameraControls controls(looking({3.0, 2.0, 5.0}, {0.0, 0.0, 0.0}), cube({0.0, 0.0, 0.0}, 1.0));
    controls.zoom(1e4);
    EXPECT_GT(controls.distance(), 0.0);
    controls.zoom(-1e5);
    EXPECT_TRUE(std::isfinite(controls.distance()));
    controls.zoom(200.0);
    EXPECT_LT(controls.distance(), 10.0);
}

// Every corner of the box is in the picture, and the box fills a good part of it.
void expect_framed(const CameraView& view, const scene::Bounds& bounds) {
    double widest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 point((corner & 1) != 0 ? bounds.high.x : bounds.low.x,
                               (corner & 2) != 0 ? bounds.high.y : bounds.low.y,
                               (corner & 4) != 0 ? bounds.high.z : bounds.low.z);
        const glm::dvec2 at = on_screen(view, point);
        EXPECT_LE(std::abs(at.y), 0.5);
        EXPECT_LE(std::abs(at.x), 0.5 * k_width / k_height);
        const glm::dvec4 camera = glm::inverse(view.world_from_camera) * glm::dvec4(point, 1.0);
        EXPECT_GT(-camera.z, view.camera.near_m);
        EXPECT_LT(-camera.z, view.camera.far_m);
        widest = std::max({widest, std::abs(at.x), std::abs(at.y)});
    }
    EXPECT_GT(widest, 0.25);
}

TEST(CameraControls, FrameAllShowsTheWholeScene) {
    // A millimetre, a kilometre, and far away from the origin.
    const std::vector<scene::Bounds> scenes = {cube({0.0, 0.0, 0.0}, 1.0), cube({1.0, 2.0, 3.0}, 5e-4),
                                               cube({0.0, 0.0, 0.0}, 500.0), cube({1e6, -1e6, 1e6}, 3.0)};
    for (const scene::Bounds& bounds : scenes) {
        for (const bool perspective : {true, false}) {
            CameraView view = looking({30.0, 2.0, 5.0}, {28.0, 1.0, 5.0});
            view.camera.perspective = perspective;
            CameraControls controls(view, bounds);
            controls.frame_all(bounds, k_width, k_height);
            expect_framed(controls.view(), bounds);
        }
    }
}

TEST(CameraControls, FrameAllHoldsForBlendersLens) {
    const scene::Bounds bounds = cube({0.0, 0.0, 0.0}, 2.0);
    for (const auto fit :
         {scene::SensorFit::automatic, scene::SensorFit::horizontal, scene::SensorFit::vertical}) {
        CameraView view = looking({3.0, 2.0, 5.0}, {0.0, 0.0, 0.0});
        view.camera.sensor = scene::Sensor{.fit = fit, .shift_x = 0.4F, .shift_y = -0.2F};
        CameraControls controls(view, bounds);
        controls.frame_all(bounds, k_width, k_height);
        expect_framed(controls.view(), bounds);
    }
}

TEST(CameraControls, ZoomingOutDoesNotCutTheSceneOff) {
    CameraView view = looking({0.0, 0.0, 5.0}, {0.0, 0.0, 0.0});
    view.camera.far_m = 10.0F;
    CameraControls controls(view, cube({0.0, 0.0, 0.0}, 1.0));
    controls.zoom(-30.0);
    EXPECT_GT(controls.view().camera.far_m, controls.distance() + std::sqrt(3.0));
}

TEST(CameraControls, AnEmptySceneHasAPivotToo) {
    CameraControls controls(looking({0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}), scene::Bounds{});
    controls.frame_all(scene::Bounds{}, k_width, k_height);
    EXPECT_TRUE(std::isfinite(controls.distance()));
    EXPECT_NEAR(glm::length(controls.pivot()), 0.0, k_tolerance);
}

}  // namespace
}  // namespace bounce::viewer
