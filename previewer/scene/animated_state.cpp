// SPDX-License-Identifier: Apache-2.0
#include "scene/animated_state.h"

#include "scene/transforms.h"

namespace bounce::scene {
namespace {

using Values = std::vector<float>;

glm::vec3 as_vec3(const Values& values) {
    return {values[0], values[1], values[2]};
}

glm::dvec3 as_dvec3(const Values& values) {
    return glm::dvec3(as_vec3(values));
}

glm::dquat rotation_of(const Values& values) {
    return normalized_rotation(glm::dquat(static_cast<double>(values[3]), static_cast<double>(values[0]),
                                          static_cast<double>(values[1]), static_cast<double>(values[2])));
}

void set_node(AnimatedState& state, Property property, size_t index, Values values) {
    Transform& local = state.locals[index];
    switch (property) {
        case Property::node_translation:
            local.translation = as_dvec3(values);
            break;
        case Property::node_rotation:
            local.rotation = rotation_of(values);
            break;
        case Property::node_scale:
            local.scale = as_dvec3(values);
            break;
        case Property::node_weights:
            state.weights[index] = std::move(values);
            break;
        default:
            state.visible[index] = values[0] != 0.0F;
            break;
    }
}

// Where a light keeps a property of one number.
float& light_number(Light& light, Property property) {
    switch (property) {
        case Property::light_irradiance_w_m2:
            return light.irradiance_w_m2;
        case Property::light_radius_m:
            return light.radius_m;
        case Property::light_angle_rad:
            return light.angle_rad;
        case Property::light_cone_angle_rad:
            return light.cone_angle_rad;
        case Property::light_blend:
            return light.blend;
        case Property::light_inner_cone_rad:
            return light.inner_cone_rad;
        case Property::light_size_x_m:
            return light.size_x_m;
        case Property::light_size_y_m:
            return light.size_y_m;
        case Property::light_spread_rad:
            return light.spread_rad;
        default:
            return light.power_w;
    }
}

void set_camera(Camera& camera, Property property, float value) {
    switch (property) {
        case Property::camera_yfov_rad:
            camera.yfov_rad = value;
            return;
        case Property::camera_xmag:
            camera.xmag = value;
            return;
        case Property::camera_ymag:
            camera.ymag = value;
            return;
        default:
            break;
    }
    if (!camera.sensor) {
        camera.sensor.emplace();
    }
    switch (property) {
        case Property::camera_focal_length_mm:
            camera.sensor->focal_length_mm = value;
            break;
        case Property::camera_ortho_scale:
            camera.sensor->ortho_scale = value;
            break;
        case Property::camera_shift_x:
            camera.sensor->shift_x = value;
            break;
        default:
            camera.sensor->shift_y = value;
            break;
    }
}

void set_material(Material& material, Property property, const Values& values) {
    switch (property) {
        case Property::material_base_color:
            material.base_color = glm::vec4(values[0], values[1], values[2], values[3]);
            break;
        case Property::material_metallic:
            material.metallic = values[0];
            break;
        case Property::material_roughness:
            material.roughness = values[0];
            break;
        case Property::material_emission:
            material.emission = as_vec3(values);
            break;
        default:
            material.emission_strength = values[0];
            break;
    }
}

void set(AnimatedState& state, Pose& pose, const AnimationChannel& channel, Values values) {
    const auto index = static_cast<size_t>(channel.index);
    switch (channel.property) {
        case Property::node_translation:
        case Property::node_rotation:
        case Property::node_scale:
        case Property::node_weights:
        case Property::node_visible:
            set_node(state, channel.property, index, std::move(values));
            break;
        case Property::light_color:
            pose.lights[index].color = as_vec3(values);
            break;
        case Property::light_power_w:
        case Property::light_irradiance_w_m2:
        case Property::light_radius_m:
        case Property::light_angle_rad:
        case Property::light_cone_angle_rad:
        case Property::light_blend:
        case Property::light_inner_cone_rad:
        case Property::light_size_x_m:
        case Property::light_size_y_m:
        case Property::light_spread_rad:
            light_number(pose.lights[index], channel.property) = values[0];
            break;
        case Property::camera_yfov_rad:
        case Property::camera_focal_length_mm:
        case Property::camera_ortho_scale:
        case Property::camera_xmag:
        case Property::camera_ymag:
        case Property::camera_shift_x:
        case Property::camera_shift_y:
            set_camera(pose.cameras[index], channel.property, values[0]);
            break;
        case Property::material_base_color:
        case Property::material_metallic:
        case Property::material_roughness:
        case Property::material_emission:
        case Property::material_emission_strength:
            set_material(pose.materials[index], channel.property, values);
            break;
        case Property::world_color:
            pose.world.color = as_vec3(values);
            break;
        case Property::world_strength:
            pose.world.strength = values[0];
            break;
        case Property::world_rotation:
            pose.world.world_from_environment = rotation_of(values);
            break;
        case Property::view_exposure:
            pose.view.exposure = values[0];
            break;
    }
}

}  // namespace

AnimatedState rest_state(const Scene& scene) {
    AnimatedState state;
    for (const Node& node : scene.nodes) {
        state.locals.push_back(node.local);
        state.visible.push_back(node.visible);
        std::vector<float>& weights = state.weights.emplace_back();
        if (node.mesh != k_none) {
            weights =
                node.weights.empty() ? scene.meshes[static_cast<size_t>(node.mesh)].weights : node.weights;
        }
    }
    return state;
}

namespace {

// Calls visit(channel, its values) for each channel that is played and wanted.
template <typename Wanted, typename Visit>
void for_each_value(const Scene& scene, double time_s, int animation, const Wanted& wanted,
                    const Visit& visit) {
    for (size_t i = 0; i < scene.animations.size(); ++i) {
        if (animation != k_all_animations && static_cast<size_t>(animation) != i) {
            continue;
        }
        const Animation& clip = scene.animations[i];
        for (const AnimationChannel& channel : clip.channels) {
            if (wanted(channel)) {
                visit(channel, sample(clip.samplers[static_cast<size_t>(channel.sampler)], time_s,
                                      channel.property == Property::node_rotation ||
                                          channel.property == Property::world_rotation));
            }
        }
    }
}

}  // namespace

void play(const Scene& scene, double time_s, int animation, AnimatedState& state, Pose& pose) {
    for_each_value(
        scene, time_s, animation, [](const AnimationChannel&) { return true; },
        [&](const AnimationChannel& channel, Values values) {
            set(state, pose, channel, std::move(values));
        });
}

std::vector<Material> play_materials(const Scene& scene, double time_s, int animation) {
    std::vector<Material> out = scene.materials;
    for_each_value(
        scene, time_s, animation,
        [](const AnimationChannel& channel) {
            return channel.property >= Property::material_base_color &&
                   channel.property <= Property::material_emission_strength;
        },
        [&](const AnimationChannel& channel, const Values& values) {
            set_material(out[static_cast<size_t>(channel.index)], channel.property, values);
        });
    return out;
}

}  // namespace bounce::scene
