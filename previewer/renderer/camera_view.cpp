// SPDX-License-Identifier: Apache-2.0
#include "renderer/camera_view.h"

#include <algorithm>
#include <cmath>

namespace bounce {
namespace {

// The frame on the plane at distance 1 (orthographic: anywhere), metres.
struct Window {
    double left, right, bottom, top;
    void move(double x, double y) {
        left += x;
        right += x;
        bottom += y;
        top += y;
    }
};

Window blender_window(const scene::Camera& camera, const scene::Sensor& sensor, double width, double height,
                      double pixel_aspect) {
    // In units of a pixel's width; a pixel is 1 wide and 1/pixel_aspect high.
    const double tall = height / pixel_aspect;
    const bool horizontal = sensor.fit == scene::SensorFit::horizontal ||
                            (sensor.fit == scene::SensorFit::automatic && width >= tall);
    const double fitted_pixels = horizontal ? width : tall;
    const double sensor_mm = sensor.fit == scene::SensorFit::vertical ? sensor.height_mm : sensor.width_mm;
    const double extent = camera.perspective ? sensor_mm / sensor.focal_length_mm : sensor.ortho_scale;
    const double pixel = extent / fitted_pixels;
    const double shift_x = sensor.shift_x * fitted_pixels;
    const double shift_y = sensor.shift_y * fitted_pixels;
    return {(-0.5 * width + shift_x) * pixel, (0.5 * width + shift_x) * pixel,
            (-0.5 * tall + shift_y) * pixel, (0.5 * tall + shift_y) * pixel};
}

Window gltf_window(const scene::Camera& camera, double width, double height, double pixel_aspect) {
    const double aspect = width * pixel_aspect / height;
    const double half_height =
        camera.perspective ? std::tan(0.5 * static_cast<double>(camera.yfov_rad)) : camera.ymag;
    return {-half_height * aspect, half_height * aspect, -half_height, half_height};
}

}  // namespace

CameraView tighten_orthographic_depth(const CameraView& view, const scene::Bounds& bounds) {
    if (view.camera.perspective || bounds.empty()) {
        return view;
    }
    const glm::dvec3 forward = -glm::normalize(glm::dvec3(view.world_from_camera[2]));
    const glm::dvec3 eye(view.world_from_camera[3]);
    const double middle = glm::dot(bounds.center() - eye, forward);
    // Half the box's extent along the view, and a little room for rounding.
    const double reach =
        0.5 * glm::dot(bounds.high - bounds.low, glm::abs(forward)) + 0.01 * bounds.diagonal();
    CameraView out = view;
    out.camera.near_m = std::max(view.camera.near_m, static_cast<float>(middle - reach));
    out.camera.far_m = std::min(view.camera.far_m, static_cast<float>(middle + reach));
    // Nothing in view: any range will do, as long as it is one.
    return out.camera.far_m > out.camera.near_m ? out : view;
}

CameraMatrices camera_matrices(const CameraView& view, int width, int height, const gpu::RenderSpace& space) {
    const scene::Camera& camera = view.camera;
    Window w = camera.sensor ? blender_window(camera, *camera.sensor, width, height, view.pixel_aspect)
                             : gltf_window(camera, width, height, view.pixel_aspect);
    w.move(view.offset_px.x * (w.right - w.left) / width, view.offset_px.y * (w.top - w.bottom) / height);
    CameraMatrices out;
    out.perspective = camera.perspective;
    // Each axis without its scale, as Cycles takes a camera: below a mirrored parent its picture is mirrored.
    const glm::dvec3 right = glm::normalize(glm::dvec3(view.world_from_camera[0]));
    const glm::dvec3 up = glm::normalize(glm::dvec3(view.world_from_camera[1]));
    const glm::dvec3 back = glm::normalize(glm::dvec3(view.world_from_camera[2]));
    out.position = space.point(glm::dvec3(view.world_from_camera[3]));
    out.forward = -back;

    const double unit = camera.perspective ? 1.0 : space.scale;
    const double near = std::max(static_cast<double>(camera.near_m), 1e-6) * space.scale;
    const double far = static_cast<double>(camera.far_m) * space.scale;
    out.pixel_radius = 0.5 * (w.top - w.bottom) * unit / height;

    glm::dmat4 clip_from_camera(0.0);
    const double x = 2.0 / ((w.right - w.left) * unit);
    const double y = 2.0 / ((w.top - w.bottom) * unit);
    const double x0 = -(w.right + w.left) / (w.right - w.left);
    const double y0 = -(w.top + w.bottom) / (w.top - w.bottom);
    clip_from_camera[0][0] = x;
    clip_from_camera[1][1] = y;
    if (camera.perspective) {
        const bool finite = std::isfinite(far) && far > near;
        clip_from_camera[2] = glm::dvec4(-x0, -y0, finite ? near / (far - near) : 0.0, -1.0);
        clip_from_camera[3][2] = finite ? near * far / (far - near) : near;
    } else {
        const double range = std::max(far - near, 1e-9);
        clip_from_camera[2][2] = 1.0 / range;
        clip_from_camera[3] = glm::dvec4(x0, y0, 1.0 + near / range, 1.0);
    }
    const glm::dmat4 camera_from_render = glm::inverse(glm::dmat4(
        glm::dvec4(right, 0.0), glm::dvec4(up, 0.0), glm::dvec4(back, 0.0), glm::dvec4(out.position, 1.0)));
    out.clip_from_render = clip_from_camera * camera_from_render;
    out.render_from_clip = glm::inverse(out.clip_from_render);
    return out;
}

}  // namespace bounce
