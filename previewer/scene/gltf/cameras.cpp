// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/cameras.h"

#include <cmath>
#include <limits>

namespace bounce::scene::gltf {
namespace {

using nlohmann::json;

SensorFit fit_of(const std::string& name) {
    if (name == "horizontal") {
        return SensorFit::horizontal;
    }
    return name == "vertical" ? SensorFit::vertical : SensorFit::automatic;
}

Sensor read_sensor(const json& description) {
    Sensor sensor;
    sensor.fit = fit_of(string_or(description, "sensor_fit", "auto"));
    sensor.width_mm = number_or(description, "sensor_width_mm", sensor.width_mm);
    sensor.height_mm = number_or(description, "sensor_height_mm", sensor.height_mm);
    sensor.focal_length_mm = number_or(description, "focal_length_mm", sensor.focal_length_mm);
    sensor.ortho_scale = number_or(description, "ortho_scale", sensor.ortho_scale);
    sensor.shift_x = number_or(description, "shift_x", sensor.shift_x);
    sensor.shift_y = number_or(description, "shift_y", sensor.shift_y);
    return sensor;
}

Camera read_camera(const json& description, size_t index) {
    Camera camera;
    camera.name = string_or(description, "name", "");
    const std::string type = description["type"].get<std::string>();
    const json* lens = member(description, type);
    if ((type != "perspective" && type != "orthographic") || lens == nullptr) {
        throw refusal("camera {} is neither perspective nor orthographic", index);
    }
    camera.near_m = number_or(*lens, "znear", camera.near_m);
    camera.far_m = number_or(*lens, "zfar", std::numeric_limits<float>::infinity());
    camera.perspective = type == "perspective";
    if (camera.perspective) {
        camera.yfov_rad = number_or(*lens, "yfov", camera.yfov_rad);
    } else {
        // A negative magnification would mirror the image; glTF advises against it.
        camera.xmag = std::abs(number_or(*lens, "xmag", camera.xmag));
        camera.ymag = std::abs(number_or(*lens, "ymag", camera.ymag));
        if (camera.xmag == 0.0F || camera.ymag == 0.0F) {
            throw refusal("camera {} has no extent", index);
        }
    }
    if (camera.far_m <= camera.near_m) {
        throw refusal("camera {} has its far plane before its near plane", index);
    }
    if (const json* blender = extension(description, "BOUNCE_scene")) {
        camera.sensor = read_sensor(*blender);
    }
    return camera;
}

}  // namespace

void read_cameras(const Source& source, Scene& scene) {
    const json& cameras = list(source.json(), "cameras");
    for (size_t i = 0; i < cameras.size(); ++i) {
        scene.cameras.push_back(read_camera(cameras[i], i));
    }
}

}  // namespace bounce::scene::gltf
