// SPDX-License-Identifier: Apache-2.0
#include "scene/pose.h"

#include "scene/animated_state.h"
#include "scene/transforms.h"

namespace bounce::scene {
namespace {

void compose_transforms(const Scene& scene, const AnimatedState& state, Pose& pose,
                        std::vector<bool>& visible) {
    pose.world_from_node.assign(scene.nodes.size(), glm::dmat4(1.0));
    visible.assign(scene.nodes.size(), false);
    for (const int index : scene.topological_order) {
        const auto at = static_cast<size_t>(index);
        const Node& node = scene.nodes[at];
        const glm::dmat4 parent_from_node = node.matrix ? *node.matrix : parent_from_local(state.locals[at]);
        visible[at] = state.visible[at];
        if (node.parent == k_none) {
            pose.world_from_node[at] = parent_from_node;
        } else {
            const auto parent = static_cast<size_t>(node.parent);
            pose.world_from_node[at] = pose.world_from_node[parent] * parent_from_node;
            visible[at] = visible[at] && visible[parent];
        }
    }
}

// glTF 2.0, 3.7.3.3: the transform of the skinned mesh's own node does not count.
void pose_skins(const Scene& scene, Pose& pose) {
    for (const Skin& skin : scene.skins) {
        std::vector<glm::dmat4>& world_from_mesh = pose.skins.emplace_back();
        world_from_mesh.reserve(skin.joints.size());
        for (size_t j = 0; j < skin.joints.size(); ++j) {
            world_from_mesh.push_back(pose.world_from_node[static_cast<size_t>(skin.joints[j])] *
                                      glm::dmat4(skin.joint_from_mesh[j]));
        }
    }
}

void list_draws(const Node& node, int index, Pose& pose) {
    if (node.skin != k_none) {
        pose.draws.push_back({index, node.mesh, node.skin, glm::dmat4(1.0)});
        return;
    }
    const glm::dmat4& world_from_node = pose.world_from_node[static_cast<size_t>(index)];
    if (node.instances.empty()) {
        pose.draws.push_back({index, node.mesh, k_none, world_from_node});
    }
    for (const glm::dmat4& node_from_instance : node.instances) {
        pose.draws.push_back({index, node.mesh, k_none, world_from_node * node_from_instance});
    }
}

}  // namespace

Pose evaluate_pose(const Scene& scene, double time_s, int animation) {
    Pose pose;
    pose.time_s = time_s;
    pose.lights = scene.lights;
    pose.cameras = scene.cameras;
    pose.materials = scene.materials;
    pose.world = scene.world;
    pose.view = scene.view;
    AnimatedState state = rest_state(scene);
    play(scene, time_s, animation, state, pose);
    for (Material& material : pose.materials) {
        material.emission *= material.emission_strength;
        material.emission_strength = 1.0F;
    }

    std::vector<bool> visible;
    compose_transforms(scene, state, pose, visible);
    pose.weights = std::move(state.weights);
    pose_skins(scene, pose);
    for (const int index : scene.topological_order) {
        const Node& node = scene.nodes[static_cast<size_t>(index)];
        if (!visible[static_cast<size_t>(index)]) {
            continue;
        }
        if (node.mesh != k_none && !scene.meshes[static_cast<size_t>(node.mesh)].primitives.empty()) {
            list_draws(node, index, pose);
        }
        if (node.light != k_none) {
            pose.light_instances.push_back(
                {index, node.light, pose.world_from_node[static_cast<size_t>(index)]});
        }
    }
    return pose;
}

int default_animation(const Scene& scene) {
    return scene.from_blender || scene.animations.empty() ? k_all_animations : 0;
}

}  // namespace bounce::scene
