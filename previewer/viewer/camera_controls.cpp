// SPDX-License-Identifier: Apache-2.0
#include "viewer/camera_controls.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace bounce::viewer {
namespace {

// A drag across the window's height turns by half a turn.
constexpr double k_radians_a_height = glm::pi<double>();
constexpr double k_zoom_a_step = 0.9;
// How near and far the pivot may be, in radii of the scene: where floats and the depth buffer still serve.
constexpr double k_nearest_radii = 1e-4;
constexpr double k_farthest_radii = 1e3;

void set_scene(const scene::Bounds& bounds, glm::dvec3& center, double& radius) {
    // Without a scene, or with a single point, a unit sphere (as scene::framing_camera).
    center = bounds.empty() ? glm::dvec3(0.0) : bounds.center();
    radius = bounds.diagonal() > 0.0 ? 0.5 * bounds.diagonal() : 1.0;
}

}  // namespace

CameraControls::CameraControls(const CameraView& view, const scene::Bounds& bounds) : lens_(view) {
    set_scene(bounds, scene_center_, scene_radius_);
    const glm::dvec3 back = glm::normalize(glm::dvec3(view.world_from_camera[2]));
    glm::dvec3 right = glm::normalize(glm::dvec3(view.world_from_camera[0]));
    const glm::dvec3 up = glm::normalize(glm::cross(back, right));
    right = glm::cross(up, back);

    pitch_ = std::asin(std::clamp(-back.y, -1.0, 1.0));
    // Straight up or down, yaw and roll are one turn: take it all as yaw.
    constexpr double nearly_upright = 1e-6;
    if (std::hypot(back.x, back.z) < nearly_upright) {
        yaw_ = std::atan2(-right.z, right.x);
    } else {
        yaw_ = std::atan2(back.x, back.z);
        roll_ = std::atan2(right.y, up.y);
    }

    const glm::dvec3 eye(view.world_from_camera[3]);
    // A centre behind the camera, or beside it, is no pivot to turn about.
    constexpr double least = 0.1;
    distance_ = std::max(glm::dot(scene_center_ - eye, -back), least * scene_radius_);
    pivot_ = eye - distance_ * back;
}

glm::dmat3 CameraControls::world_from_camera() const {
    glm::dmat4 matrix = glm::rotate(glm::dmat4(1.0), yaw_, glm::dvec3(0.0, 1.0, 0.0));
    matrix = glm::rotate(matrix, pitch_, glm::dvec3(1.0, 0.0, 0.0));
    return glm::dmat3(glm::rotate(matrix, roll_, glm::dvec3(0.0, 0.0, 1.0)));
}

void CameraControls::orbit(double right, double down) {
    constexpr double upright = glm::half_pi<double>();
    yaw_ = std::remainder(yaw_ - right * k_radians_a_height, glm::two_pi<double>());
    pitch_ = std::clamp(pitch_ - down * k_radians_a_height, -upright, upright);
}

double CameraControls::visible_height(int width, int height) const {
    const CameraMatrices matrices = camera_matrices(lens_, width, height, gpu::RenderSpace{});
    return 2.0 * matrices.pixel_radius * height * (lens_.camera.perspective ? distance_ : 1.0);
}

void CameraControls::pan(double right, double down, int width, int height) {
    const glm::dmat3 axes = world_from_camera();
    pivot_ += visible_height(width, height) * (down * axes[1] - right * axes[0]);
}

void CameraControls::scale_orthographic(double factor) {
    const auto scale = static_cast<float>(factor);
    lens_.camera.xmag *= scale;
    lens_.camera.ymag *= scale;
    if (lens_.camera.sensor) {
        lens_.camera.sensor->ortho_scale *= scale;
    }
}

void CameraControls::zoom(double steps) {
    const double factor = std::pow(k_zoom_a_step, steps);
    if (lens_.camera.perspective) {
        distance_ =
            std::clamp(distance_ * factor, k_nearest_radii * scene_radius_, k_farthest_radii * scene_radius_);
    } else {
        scale_orthographic(factor);
    }
}

void CameraControls::frame_all(const scene::Bounds& bounds, int width, int height) {
    set_scene(bounds, scene_center_, scene_radius_);
    pivot_ = scene_center_;
    if (lens_.camera.sensor) {
        lens_.camera.sensor->shift_x = 0.0F;
        lens_.camera.sensor->shift_y = 0.0F;
    }
    constexpr double margin = 1.05;
    distance_ = 1.0;
    const double tall = visible_height(width, height);
    const double wide = tall * width * lens_.pixel_aspect / height;
    const double smaller = std::min(tall, wide);
    if (lens_.camera.perspective) {
        distance_ = margin * scene_radius_ / std::sin(std::atan(0.5 * smaller));
    } else {
        distance_ = 2.0 * margin * scene_radius_;
        scale_orthographic(2.0 * margin * scene_radius_ / smaller);
    }
}

CameraView CameraControls::view() const {
    const glm::dmat3 axes = world_from_camera();
    const glm::dvec3 eye = pivot_ + distance_ * axes[2];
    CameraView view = lens_;
    view.world_from_camera = glm::dmat4(axes);
    view.world_from_camera[3] = glm::dvec4(eye, 1.0);
    // Reversed float depth gives a near plane away cheaply; the far one must not cut what zooming out shows.
    constexpr double near_part = 0.01;
    const double to_far_side = glm::distance(eye, scene_center_) + scene_radius_;
    view.camera.near_m = std::min(view.camera.near_m, static_cast<float>(near_part * distance_));
    view.camera.far_m = std::max(view.camera.far_m, static_cast<float>(1.1 * to_far_side));
    return view;
}

}  // namespace bounce::viewer
