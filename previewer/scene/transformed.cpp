// SPDX-License-Identifier: Apache-2.0
#include "scene/transformed.h"

#include <optional>

#include "scene/primitive_bounds.h"

namespace bounce::scene {
namespace {

// What each animated property is multiplied by; nothing where it stays.
using PropertyFactor = std::optional<double> (*)(Property property, double factor);

std::optional<double> factor_of_length(Property property, double factor) {
    switch (property) {
        case Property::node_translation:
        case Property::light_radius_m:
        case Property::light_size_x_m:
        case Property::light_size_y_m:
        case Property::camera_ortho_scale:
        case Property::camera_xmag:
        case Property::camera_ymag:
            return factor;
        case Property::light_power_w:
            return factor * factor;
        default:
            return std::nullopt;
    }
}

std::optional<double> factor_of_light(Property property, double factor) {
    switch (property) {
        case Property::light_power_w:
        case Property::light_irradiance_w_m2:
        case Property::material_emission_strength:
        case Property::world_strength:
            return factor;
        default:
            return std::nullopt;
    }
}

// Channels may share a sampler, so what changes gets one of its own.
void multiply_channels(Scene& scene, PropertyFactor factor_of, double factor) {
    for (Animation& animation : scene.animations) {
        for (AnimationChannel& channel : animation.channels) {
            if (const std::optional<double> times = factor_of(channel.property, factor)) {
                AnimationSampler sampler = animation.samplers[static_cast<size_t>(channel.sampler)];
                for (float& value : sampler.values) {
                    value = static_cast<float>(value * *times);
                }
                channel.sampler = static_cast<int>(animation.samplers.size());
                animation.samplers.push_back(std::move(sampler));
            }
        }
    }
}

template <typename Vector>
void multiply(std::vector<Vector>& positions, double factor) {
    for (Vector& position : positions) {
        position = Vector(glm::dvec3(position) * factor);
    }
}

void multiply(float& value, double factor) {
    value = static_cast<float>(value * factor);
}

template <typename Matrix>
void multiply_translation(Matrix& matrix, double factor) {
    for (glm::length_t i = 0; i < 3; ++i) {
        matrix[3][i] = static_cast<typename Matrix::value_type>(matrix[3][i] * factor);
    }
}

void put_below(Scene& scene, const Transform& local) {
    Node node;
    node.name = "all";
    node.local = local;
    node.children = scene.roots;
    const auto index = static_cast<int>(scene.nodes.size());
    for (const int root : scene.roots) {
        scene.nodes[static_cast<size_t>(root)].parent = index;
    }
    scene.nodes.push_back(std::move(node));
    scene.roots = {index};
    scene.topological_order.insert(scene.topological_order.begin(), index);
}

}  // namespace

Scene scaled(Scene scene, double factor) {
    for (Mesh& mesh : scene.meshes) {
        for (Primitive& primitive : mesh.primitives) {
            multiply(primitive.positions, factor);
            for (MorphTarget& target : primitive.targets) {
                multiply(target.positions, factor);
            }
            primitive.bounds = primitive_bounds(primitive);
        }
    }
    for (Node& node : scene.nodes) {
        node.local.translation *= factor;
        if (node.matrix) {
            multiply_translation(*node.matrix, factor);
        }
        for (glm::dmat4& instance : node.instances) {
            multiply_translation(instance, factor);
        }
    }
    for (Skin& skin : scene.skins) {
        for (glm::mat4& joint_from_mesh : skin.joint_from_mesh) {
            multiply_translation(joint_from_mesh, factor);
        }
    }
    for (Light& light : scene.lights) {
        multiply(light.power_w, factor * factor);
        multiply(light.radius_m, factor);
        multiply(light.size_x_m, factor);
        multiply(light.size_y_m, factor);
    }
    for (Camera& camera : scene.cameras) {
        multiply(camera.xmag, factor);
        multiply(camera.ymag, factor);
        multiply(camera.near_m, factor);
        multiply(camera.far_m, factor);
        if (camera.sensor) {
            multiply(camera.sensor->ortho_scale, factor);
        }
    }
    multiply_channels(scene, factor_of_length, factor);
    return scene;
}

Scene moved(Scene scene, const glm::dvec3& by) {
    Transform local;
    local.translation = by;
    put_below(scene, local);
    return scene;
}

Scene turned(Scene scene, const glm::dquat& by) {
    Transform local;
    local.rotation = glm::normalize(by);
    put_below(scene, local);
    scene.world.world_from_environment = local.rotation * scene.world.world_from_environment;
    for (Animation& animation : scene.animations) {
        for (AnimationChannel& channel : animation.channels) {
            if (channel.property != Property::world_rotation) {
                continue;
            }
            AnimationSampler sampler = animation.samplers[static_cast<size_t>(channel.sampler)];
            // Tangents of splines turn as values do: the product is linear in them.
            for (size_t i = 0; i + 3 < sampler.values.size(); i += 4) {
                float* xyzw = &sampler.values[i];
                const glm::dquat q = local.rotation * glm::dquat(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
                xyzw[0] = static_cast<float>(q.x);
                xyzw[1] = static_cast<float>(q.y);
                xyzw[2] = static_cast<float>(q.z);
                xyzw[3] = static_cast<float>(q.w);
            }
            channel.sampler = static_cast<int>(animation.samplers.size());
            animation.samplers.push_back(std::move(sampler));
        }
    }
    return scene;
}

Scene relit(Scene scene, double factor) {
    for (Light& light : scene.lights) {
        multiply(light.power_w, factor);
        multiply(light.irradiance_w_m2, factor);
    }
    for (Material& material : scene.materials) {
        multiply(material.emission_strength, factor);
    }
    multiply(scene.world.strength, factor);
    multiply_channels(scene, factor_of_light, factor);
    return scene;
}

}  // namespace bounce::scene
