// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_features.h"

#include <algorithm>
#include <set>

#include "scene/pose.h"

namespace bounce::scene {
namespace {

// A dielectric as rough as this, or rougher, reflects so widely that a diffuse bounce stands for it;
// Blender's default material (roughness 0.5) is just not glossy.
constexpr float k_glossy_below_roughness = 0.5F;
constexpr float k_glossy_above_metallic = 0.0F;

// What a channel of each node would move: everything below it.
struct Below {
    std::vector<bool> geometry;
    std::vector<bool> light;
    std::vector<bool> camera;
};

Below find_below(const Scene& scene) {
    Below below{std::vector<bool>(scene.nodes.size()), std::vector<bool>(scene.nodes.size()),
                std::vector<bool>(scene.nodes.size())};
    for (const Node& node : scene.nodes) {
        if (node.mesh != k_none && node.skin != k_none) {
            // A skinned mesh moves with its joints.
            for (const int joint : scene.skins[static_cast<size_t>(node.skin)].joints) {
                below.geometry[static_cast<size_t>(joint)] = true;
            }
        }
    }
    const auto& order = scene.topological_order;
    for (auto i = order.rbegin(); i != order.rend(); ++i) {
        const auto at = static_cast<size_t>(*i);
        const Node& node = scene.nodes[at];
        below.geometry[at] = below.geometry[at] || node.mesh != k_none;
        below.light[at] = below.light[at] || node.light != k_none;
        below.camera[at] = below.camera[at] || node.camera != k_none;
        if (node.parent != k_none) {
            const auto parent = static_cast<size_t>(node.parent);
            below.geometry[parent] = below.geometry[parent] || below.geometry[at];
            below.light[parent] = below.light[parent] || below.light[at];
            below.camera[parent] = below.camera[parent] || below.camera[at];
        }
    }
    return below;
}

bool any_above_zero(const glm::vec3& color) {
    return glm::any(glm::greaterThan(color, glm::vec3(0.0F)));
}

void add_material(const Material& material, SceneFeatures& features) {
    features.base_color_texture |= material.base_color_texture.present();
    features.metallic_roughness_texture |= material.metallic_roughness_texture.present();
    features.normal_texture |= material.normal_texture.present();
    features.alpha_mask |= material.alpha_mode == AlphaMode::mask;
    features.alpha_blend |= material.alpha_mode == AlphaMode::blend;
    features.double_sided |= material.double_sided;
    features.unlit |= material.unlit;
    features.disney_diffuse |= material.diffuse == DiffuseModel::disney;
    features.reflects |= !material.unlit && any_above_zero(glm::vec3(material.base_color));
    if (any_above_zero(material.emission * material.emission_strength)) {
        features.emissive = true;
        features.emission_texture |= material.emission_texture.present();
    }
    // Factors bound what their textures can reach.
    const bool textured = material.metallic_roughness_texture.present();
    features.glossy |=
        !material.unlit && (material.metallic > k_glossy_above_metallic || textured ||
                            (material.roughness < k_glossy_below_roughness && material.specular > 0.0F));
}

void add_drawn_node(const Scene& scene, const Node& node, std::set<int>& used_materials,
                    SceneFeatures& features) {
    const auto copies =
        static_cast<int>(std::max<size_t>(node.skin == k_none ? node.instances.size() : 1, 1));
    const Mesh& mesh = scene.meshes[static_cast<size_t>(node.mesh)];
    if (mesh.primitives.empty()) {
        return;
    }
    features.draws += copies;
    features.skinned |= node.skin != k_none;
    for (const Primitive& primitive : mesh.primitives) {
        features.triangles += primitive.indices.size() / 3 * static_cast<size_t>(copies);
        features.vertices += primitive.positions.size() * static_cast<size_t>(copies);
        features.vertex_colors |= !primitive.colors.empty();
        features.morphed |= !primitive.targets.empty();
        if (used_materials.insert(primitive.material).second) {
            static const Material default_material;
            add_material(primitive.material == k_none
                             ? default_material
                             : scene.materials[static_cast<size_t>(primitive.material)],
                         features);
        }
    }
}

void add_light(const Scene& scene, int light, SceneFeatures& features) {
    switch (scene.lights[static_cast<size_t>(light)].type) {
        case LightType::point:
            ++features.point_lights;
            break;
        case LightType::spot:
            ++features.spot_lights;
            break;
        case LightType::sun:
            ++features.sun_lights;
            break;
        case LightType::area:
            ++features.area_lights;
            break;
    }
}

void add_animated_material(const AnimationSampler& sampler, Property property, const Material& material,
                           SceneFeatures& features) {
    features.animated_materials = true;
    const bool above_zero =
        std::any_of(sampler.values.begin(), sampler.values.end(), [](float x) { return x > 0.0F; });
    if ((property == Property::material_emission || property == Property::material_emission_strength) &&
        above_zero) {
        features.emissive = true;
        features.emission_texture |= material.emission_texture.present();
    }
    features.reflects |= property == Property::material_base_color && !material.unlit && above_zero;
    // Which values the curve passes is not looked at: being glossy for one frame is being glossy.
    features.glossy |= property == Property::material_metallic || property == Property::material_roughness;
}

void add_channel(const Scene& scene, const Below& below, const Animation& clip,
                 const AnimationChannel& channel, SceneFeatures& features) {
    const auto index = static_cast<size_t>(channel.index);
    const Property property = channel.property;
    if (property <= Property::node_visible) {
        features.animated_geometry |= below.geometry[index];
        features.animated_lights |= below.light[index];
        features.animated_camera |= below.camera[index] && property != Property::node_visible;
    } else if (property <= Property::light_spread_rad) {
        features.animated_lights = true;
    } else if (property <= Property::camera_shift_y) {
        features.animated_camera = true;
    } else if (property <= Property::material_emission_strength) {
        add_animated_material(clip.samplers[static_cast<size_t>(channel.sampler)], property,
                              scene.materials[index], features);
    } else if (property != Property::view_exposure) {
        features.animated_world = true;
        features.world_not_black = true;
    }
}

}  // namespace

SceneFeatures scene_features(const Scene& scene, int animation) {
    SceneFeatures features;
    std::set<int> used_materials;
    for (const int index : scene.topological_order) {
        const Node& node = scene.nodes[static_cast<size_t>(index)];
        if (node.mesh != k_none) {
            add_drawn_node(scene, node, used_materials, features);
        }
        if (node.light != k_none) {
            add_light(scene, node.light, features);
        }
    }
    features.materials = static_cast<int>(used_materials.size());
    features.world_not_black = any_above_zero(scene.world.color * scene.world.strength);
    const Below below = find_below(scene);
    for (size_t i = 0; i < scene.animations.size(); ++i) {
        if (animation == k_all_animations || static_cast<size_t>(animation) == i) {
            for (const AnimationChannel& channel : scene.animations[i].channels) {
                add_channel(scene, below, scene.animations[i], channel, features);
            }
        }
    }
    return features;
}

}  // namespace bounce::scene
