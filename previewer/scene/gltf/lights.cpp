// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/lights.h"

#include "scene/gltf/bounce_extension.h"

namespace bounce::scene::gltf {
namespace {

using nlohmann::json;

constexpr float k_default_outer_cone_rad = 0.7853981634F;  // a quarter of pi, KHR_lights_punctual

glm::vec3 color_of(const json& description) {
    const json* color = member(description, "color");
    return color == nullptr
               ? glm::vec3(1.0F)
               : glm::vec3((*color)[0].get<float>(), (*color)[1].get<float>(), (*color)[2].get<float>());
}

Light read_punctual(const json& description, size_t index) {
    Light light;
    light.name = string_or(description, "name", "");
    light.color = color_of(description);
    light.profile = SpotProfile::khronos;
    const float intensity = number_or(description, "intensity", 1.0F);
    const auto type = description["type"].get<std::string>();
    if (type == "directional") {
        light.type = LightType::sun;
        light.irradiance_w_m2 = intensity * k_irradiance_per_lux;
    } else if (type == "point") {
        light.type = LightType::point;
        light.power_w = intensity * k_watts_per_candela;
    } else if (type == "spot") {
        light.type = LightType::spot;
        light.power_w = intensity * k_watts_per_candela;
        const json& spot = list(description, "spot");
        light.inner_cone_rad = number_or(spot, "innerConeAngle", 0.0F);
        light.cone_angle_rad = 2.0F * number_or(spot, "outerConeAngle", k_default_outer_cone_rad);
    } else {
        throw refusal("light {} has the unknown type {}", index, type);
    }
    return light;
}

}  // namespace

std::vector<int> read_lights(Source& source, Scene& scene) {
    const json* root = extension(source.json(), "KHR_lights_punctual");
    static const json none = json::object();
    const json& punctual = list(root == nullptr ? none : *root, "lights");
    std::vector<int> scene_light(punctual.size(), k_none);

    scene.lights = read_blender_lights(source);
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        const json& description = source.json()["nodes"][i];
        if (const json* ours = extension(description, "BOUNCE_scene");
            ours != nullptr && ours->contains("light")) {
            scene.nodes[i].light = (*ours)["light"].get<int>();
            continue;
        }
        const json* theirs = extension(description, "KHR_lights_punctual");
        if (theirs == nullptr || !theirs->contains("light")) {
            continue;
        }
        const auto from = (*theirs)["light"].get<size_t>();
        if (scene_light[from] == k_none) {
            scene.lights.push_back(read_punctual(punctual[from], from));
            scene_light[from] = static_cast<int>(scene.lights.size()) - 1;
        }
        scene.nodes[i].light = scene_light[from];
    }
    return scene_light;
}

}  // namespace bounce::scene::gltf
