// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/animation_pointer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include "scene/gltf/lights.h"

namespace bounce::scene::gltf {
namespace {

// Which list the number in a pointer counts.
enum class List { none, node, blender_light, khr_light, camera, material };

struct Entry {
    std::string_view pattern;  // '#' stands for the number
    Property property{};
    List list = List::none;
    int components = 1;
    float factor = 1.0F;
};

// Weights take as many components as the mesh has targets.
constexpr int k_per_target = 0;

constexpr std::array k_entries = std::to_array<Entry>({
    {"/nodes/#/translation", Property::node_translation, List::node, 3},
    {"/nodes/#/rotation", Property::node_rotation, List::node, 4},
    {"/nodes/#/scale", Property::node_scale, List::node, 3},
    {"/nodes/#/weights", Property::node_weights, List::node, k_per_target},
    {"/nodes/#/extensions/KHR_node_visibility/visible", Property::node_visible, List::node},

    {"/extensions/BOUNCE_scene/lights/#/color", Property::light_color, List::blender_light, 3},
    {"/extensions/BOUNCE_scene/lights/#/power_w", Property::light_power_w, List::blender_light},
    {"/extensions/BOUNCE_scene/lights/#/irradiance_w_m2", Property::light_irradiance_w_m2,
     List::blender_light},
    {"/extensions/BOUNCE_scene/lights/#/radius_m", Property::light_radius_m, List::blender_light},
    {"/extensions/BOUNCE_scene/lights/#/angle_rad", Property::light_angle_rad, List::blender_light},
    {"/extensions/BOUNCE_scene/lights/#/cone_angle_rad", Property::light_cone_angle_rad, List::blender_light},
    {"/extensions/BOUNCE_scene/lights/#/blend", Property::light_blend, List::blender_light},
    {"/extensions/BOUNCE_scene/lights/#/size_x_m", Property::light_size_x_m, List::blender_light},
    {"/extensions/BOUNCE_scene/lights/#/size_y_m", Property::light_size_y_m, List::blender_light},
    {"/extensions/BOUNCE_scene/lights/#/spread_rad", Property::light_spread_rad, List::blender_light},

    {"/extensions/KHR_lights_punctual/lights/#/color", Property::light_color, List::khr_light, 3},
    // The property and factor of an intensity depend on the light's type: see khr_intensity().
    {"/extensions/KHR_lights_punctual/lights/#/intensity", Property::light_power_w, List::khr_light},
    {"/extensions/KHR_lights_punctual/lights/#/spot/innerConeAngle", Property::light_inner_cone_rad,
     List::khr_light},
    {"/extensions/KHR_lights_punctual/lights/#/spot/outerConeAngle", Property::light_cone_angle_rad,
     List::khr_light, 1, 2.0F},

    {"/cameras/#/perspective/yfov", Property::camera_yfov_rad, List::camera},
    {"/cameras/#/orthographic/xmag", Property::camera_xmag, List::camera},
    {"/cameras/#/orthographic/ymag", Property::camera_ymag, List::camera},
    {"/cameras/#/extensions/BOUNCE_scene/focal_length_mm", Property::camera_focal_length_mm, List::camera},
    {"/cameras/#/extensions/BOUNCE_scene/ortho_scale", Property::camera_ortho_scale, List::camera},
    {"/cameras/#/extensions/BOUNCE_scene/shift_x", Property::camera_shift_x, List::camera},
    {"/cameras/#/extensions/BOUNCE_scene/shift_y", Property::camera_shift_y, List::camera},

    {"/materials/#/pbrMetallicRoughness/baseColorFactor", Property::material_base_color, List::material, 4},
    {"/materials/#/pbrMetallicRoughness/metallicFactor", Property::material_metallic, List::material},
    {"/materials/#/pbrMetallicRoughness/roughnessFactor", Property::material_roughness, List::material},
    {"/materials/#/emissiveFactor", Property::material_emission, List::material, 3},
    {"/materials/#/extensions/KHR_materials_emissive_strength/emissiveStrength",
     Property::material_emission_strength, List::material},

    {"/extensions/BOUNCE_scene/world/color", Property::world_color, List::none, 3},
    {"/extensions/BOUNCE_scene/world/strength", Property::world_strength},
    {"/extensions/BOUNCE_scene/world/rotation", Property::world_rotation, List::none, 4},
    {"/extensions/BOUNCE_scene/view/exposure", Property::view_exposure},
});

// A culling hint that no light here obeys: nothing is lost when it moves.
constexpr std::string_view k_range_pattern = "/extensions/KHR_lights_punctual/lights/#/range";

struct Parsed {
    std::string pattern;
    size_t number = 0;
};

// "/nodes/12/scale" becomes "/nodes/#/scale" and 12. A pointer that is animated has one number.
Parsed parse(const std::string& pointer) {
    Parsed parsed;
    size_t at = 0;
    while (at < pointer.size()) {
        const size_t end = std::min(pointer.find('/', at + 1), pointer.size());
        const std::string_view part = std::string_view(pointer).substr(at + 1, end - at - 1);
        size_t number = 0;
        const auto result = std::from_chars(part.data(), part.data() + part.size(), number);
        if (!part.empty() && result.ec == std::errc() && result.ptr == part.data() + part.size()) {
            parsed.number = number;
            parsed.pattern += "/#";
        } else {
            parsed.pattern += '/';
            parsed.pattern += part;
        }
        at = end;
    }
    return parsed;
}

size_t size_of(const Source& source, const Scene& scene, const std::vector<int>& khr_lights, List kind) {
    switch (kind) {
        case List::none:
            break;
        case List::node:
            return scene.nodes.size();
        case List::blender_light: {
            const nlohmann::json* root = extension(source.json(), "BOUNCE_scene");
            return root == nullptr ? 0 : list(*root, "lights").size();
        }
        case List::khr_light:
            return khr_lights.size();
        case List::camera:
            return scene.cameras.size();
        case List::material:
            return scene.materials.size();
    }
    return 1;
}

void khr_intensity(const Scene& scene, ChannelTarget& target) {
    if (scene.lights[static_cast<size_t>(target.index)].type == LightType::sun) {
        target.property = Property::light_irradiance_w_m2;
        target.factor = k_irradiance_per_lux;
    } else {
        target.factor = k_watts_per_candela;
    }
}

// Node channels that cannot be carried out are passed over.
std::optional<ChannelTarget> node_target(Source& source, const Scene& scene, ChannelTarget target) {
    const Node& node = scene.nodes[static_cast<size_t>(target.index)];
    if (target.property == Property::node_weights) {
        const size_t targets =
            node.mesh == k_none ? 0 : scene.meshes[static_cast<size_t>(node.mesh)].weights.size();
        if (targets == 0) {
            source.warn(fmt::format("the morph weights of node {} are animated, and its mesh has no targets",
                                    target.index));
            return std::nullopt;
        }
        target.components = static_cast<int>(targets);
    } else if (target.property != Property::node_visible && node.matrix) {
        source.warn(
            fmt::format("node {} is given as a matrix, so its animation cannot be played", target.index));
        return std::nullopt;
    }
    return target;
}

}  // namespace

std::optional<ChannelTarget> resolve_pointer(Source& source, const Scene& scene,
                                             const std::vector<int>& khr_lights, const std::string& pointer) {
    const Parsed parsed = parse(pointer);
    const auto* entry = std::find_if(k_entries.begin(), k_entries.end(),
                                     [&](const Entry& e) { return e.pattern == parsed.pattern; });
    if (entry == k_entries.end()) {
        if (parsed.pattern != k_range_pattern) {
            source.warn(fmt::format("the animation of {} is not supported", parsed.pattern));
        }
        return std::nullopt;
    }
    if (entry->list != List::none && parsed.number >= size_of(source, scene, khr_lights, entry->list)) {
        throw refusal("an animation moves {}, which is not there", pointer);
    }
    ChannelTarget target{entry->property, static_cast<int>(parsed.number), entry->components, entry->factor};
    switch (entry->list) {
        case List::none:
            target.index = 0;
            return target;
        case List::node:
            return node_target(source, scene, target);
        case List::khr_light:
            target.index = khr_lights[parsed.number];
            if (target.index == k_none) {
                return std::nullopt;  // BOUNCE_scene describes it, or no node uses it
            }
            if (entry->property == Property::light_power_w) {
                khr_intensity(scene, target);
            }
            return target;
        case List::blender_light:
        case List::camera:
        case List::material:
            return target;
    }
    return std::nullopt;
}

std::optional<ChannelTarget> resolve_path(Source& source, const Scene& scene, int node,
                                          const std::string& path) {
    if (path == "translation") {
        return node_target(source, scene, {Property::node_translation, node, 3});
    }
    if (path == "rotation") {
        return node_target(source, scene, {Property::node_rotation, node, 4});
    }
    if (path == "scale") {
        return node_target(source, scene, {Property::node_scale, node, 3});
    }
    if (path == "weights") {
        return node_target(source, scene, {Property::node_weights, node, k_per_target});
    }
    source.warn(fmt::format("the animation path {} is not known and was passed over", path));
    return std::nullopt;
}

}  // namespace bounce::scene::gltf
