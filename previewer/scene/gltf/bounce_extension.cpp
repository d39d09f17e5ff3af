// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/bounce_extension.h"

#include <algorithm>
#include <cmath>

#include "scene/environment.h"
#include "scene/gltf/default_settings.h"
#include "scene/gltf/environment_image.h"
#include "scene/transforms.h"

namespace bounce::scene::gltf {
namespace {

using nlohmann::json;

constexpr int k_known_version = 1;

const json* blender_root(const Source& source) {
    return extension(source.json(), "BOUNCE_scene");
}

glm::vec3 color_or(const json& object, const char* key, const glm::vec3& otherwise) {
    const json* color = member(object, key);
    return color == nullptr
               ? otherwise
               : glm::vec3((*color)[0].get<float>(), (*color)[1].get<float>(), (*color)[2].get<float>());
}

std::vector<int> blender_version(const json& root) {
    std::vector<int> version;
    for (const json& number : list(list(root, "generator"), "blender")) {
        version.push_back(number.get<int>());
    }
    return version;
}

LightType type_of(const std::string& name, size_t index) {
    if (name == "point") {
        return LightType::point;
    }
    if (name == "spot") {
        return LightType::spot;
    }
    if (name == "sun") {
        return LightType::sun;
    }
    if (name == "area") {
        return LightType::area;
    }
    throw refusal("light {} of BOUNCE_scene has the unknown type {}", index, name);
}

AreaShape shape_of(const std::string& name, size_t index) {
    if (name == "square") {
        return AreaShape::square;
    }
    if (name == "rectangle") {
        return AreaShape::rectangle;
    }
    if (name == "disk") {
        return AreaShape::disk;
    }
    if (name == "ellipse") {
        return AreaShape::ellipse;
    }
    throw refusal("light {} of BOUNCE_scene has the unknown shape {}", index, name);
}

LightPattern read_pattern(const json& description, size_t index) {
    LightPattern pattern;
    pattern.width = description["width"].get<int>();
    pattern.height = description["height"].get<int>();
    const auto rgb = description["rgb"].get<std::vector<float>>();
    const size_t cells = static_cast<size_t>(pattern.width) * static_cast<size_t>(pattern.height);
    if (rgb.size() != 3 * cells) {
        throw refusal("light {} of BOUNCE_scene has a pattern of {} x {} with {} numbers", index,
                      pattern.width, pattern.height, rgb.size());
    }
    if (std::any_of(rgb.begin(), rgb.end(), [](float value) { return value < 0.0F; })) {
        throw refusal("light {} of BOUNCE_scene has a pattern with values below 0", index);
    }
    for (size_t i = 0; i < cells; ++i) {
        pattern.cells.emplace_back(rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]);
    }
    return pattern;
}

Light read_light(const json& description, size_t index, SpotProfile profile) {
    Light light;
    light.name = string_or(description, "name", "");
    light.type = type_of(description["type"].get<std::string>(), index);
    light.color = color_or(description, "color", light.color);
    light.power_w = number_or(description, "power_w", light.power_w);
    light.irradiance_w_m2 = number_or(description, "irradiance_w_m2", light.irradiance_w_m2);
    light.radius_m = number_or(description, "radius_m", light.radius_m);
    light.angle_rad = number_or(description, "angle_rad", light.angle_rad);
    light.cone_angle_rad = number_or(description, "cone_angle_rad", light.cone_angle_rad);
    light.blend = number_or(description, "blend", light.blend);
    light.profile = profile;
    light.shape = shape_of(string_or(description, "shape", "square"), index);
    light.size_x_m = number_or(description, "size_x_m", light.size_x_m);
    light.size_y_m = number_or(description, "size_y_m", light.size_x_m);
    light.spread_rad = number_or(description, "spread_rad", light.spread_rad);
    light.cast_shadow = description.value("cast_shadow", true);
    if (const json* pattern = member(description, "pattern"); pattern && light.type == LightType::area) {
        light.pattern = read_pattern(*pattern, index);
    }
    return light;
}

void read_frames(const json& root, Scene& scene) {
    if (const json* frames = member(root, "frames")) {
        scene.frames.start = (*frames)["start"].get<int>();
        scene.frames.end = (*frames)["end"].get<int>();
        scene.frames.fps = (*frames)["fps"].get<double>();
        if (scene.frames.end < scene.frames.start) {
            throw refusal("BOUNCE_scene ends at frame {}, before it starts at {}", scene.frames.end,
                          scene.frames.start);
        }
    }
}

void read_render_and_view(const json& root, Scene& scene) {
    const json& render = list(root, "render");
    scene.render.width = int_or(render, "width", scene.render.width);
    scene.render.height = int_or(render, "height", scene.render.height);
    scene.render.pixel_aspect_x = number_or(render, "pixel_aspect_x", scene.render.pixel_aspect_x);
    scene.render.pixel_aspect_y = number_or(render, "pixel_aspect_y", scene.render.pixel_aspect_y);
    scene.render.film_exposure = number_or(render, "film_exposure", scene.render.film_exposure);
    const json& view = list(root, "view");
    scene.view.display_device = string_or(view, "display_device", scene.view.display_device);
    scene.view.view_transform = string_or(view, "view_transform", scene.view.view_transform);
    scene.view.look = string_or(view, "look", scene.view.look);
    scene.view.exposure = number_or(view, "exposure", scene.view.exposure);
    scene.view.gamma = number_or(view, "gamma", scene.view.gamma);
}

void read_camera(Source& source, const json& root, Scene& scene) {
    const int node = int_or(root, "camera", k_none);
    if (node == k_none) {
        return;
    }
    const auto& order = scene.topological_order;
    if (scene.nodes[static_cast<size_t>(node)].camera == k_none ||
        std::find(order.begin(), order.end(), node) == order.end()) {
        source.warn(
            fmt::format("BOUNCE_scene names node {} as its camera, which is none or not in the scene", node));
        return;
    }
    scene.active_camera_node = node;
}

}  // namespace

std::vector<Light> read_blender_lights(Source& source) {
    std::vector<Light> lights;
    const json* root = blender_root(source);
    if (root == nullptr) {
        return lights;
    }
    const std::vector<int> version = blender_version(*root);
    const SpotProfile profile =
        !version.empty() && version[0] >= 4 ? SpotProfile::cycles_4 : SpotProfile::cycles_3;
    const json& descriptions = list(*root, "lights");
    for (size_t i = 0; i < descriptions.size(); ++i) {
        lights.push_back(read_light(descriptions[i], i, profile));
    }
    return lights;
}

void read_scene_settings(Source& source, Buffers& buffers, Scene& scene) {
    const json* root = blender_root(source);
    if (root == nullptr) {
        set_default_settings(scene);
        return;
    }
    scene.from_blender = true;
    if ((*root)["version"].get<double>() > k_known_version) {
        source.warn(fmt::format(
            "BOUNCE_scene is of version {}, newer than the {} known here; what is new is passed over",
            (*root)["version"].dump(), k_known_version));
    }
    scene.blender_version = blender_version(*root);
    read_frames(*root, scene);
    read_render_and_view(*root, scene);
    if (const json* world = member(*root, "world")) {
        scene.world.color = color_or(*world, "color", scene.world.color);
        scene.world.strength = number_or(*world, "strength", scene.world.strength);
        if (const json* rotation = member(*world, "rotation")) {
            const json& q = *rotation;
            scene.world.world_from_environment = normalized_rotation(
                glm::dquat(q[3].get<double>(), q[0].get<double>(), q[1].get<double>(), q[2].get<double>()));
        }
        if (const json* image = member(*world, "image")) {
            scene.environment = read_environment(source, buffers, *image);
        }
        if (scene.environment) {
            scene.world.color = mean_radiance(*scene.environment);
        }
    } else {
        scene.world.strength = 0.0F;
    }
    read_camera(source, *root, scene);
    for (const json& item : list(*root, "unsupported")) {
        scene.unsupported.push_back({item["object"].get<std::string>(), item["what"].get<std::string>()});
    }
}

}  // namespace bounce::scene::gltf
