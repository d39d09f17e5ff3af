// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/nodes.h"

#include <algorithm>

#include "scene/gltf/instancing.h"
#include "scene/transforms.h"

namespace bounce::scene::gltf {
namespace {

Node read_node(Source& source, const Accessors& accessors, const Scene& scene, size_t index) {
    const tinygltf::Node& typed = source.model.nodes[index];
    const nlohmann::json& description = source.json()["nodes"][index];
    Node node;
    node.name = typed.name;
    node.children = typed.children;
    node.mesh = typed.mesh;
    node.skin = typed.mesh >= 0 ? typed.skin : k_none;
    node.camera = typed.camera;
    if (typed.matrix.size() == 16) {
        glm::dmat4 matrix;
        std::copy(typed.matrix.begin(), typed.matrix.end(), &matrix[0][0]);
        node.matrix = matrix;
    }
    if (typed.translation.size() == 3) {
        node.local.translation = {typed.translation[0], typed.translation[1], typed.translation[2]};
    }
    if (typed.rotation.size() == 4) {
        const std::vector<double>& xyzw = typed.rotation;
        node.local.rotation = normalized_rotation(glm::dquat(xyzw[3], xyzw[0], xyzw[1], xyzw[2]));
    }
    if (typed.scale.size() == 3) {
        node.local.scale = {typed.scale[0], typed.scale[1], typed.scale[2]};
    }
    if (const nlohmann::json* visibility = extension(description, "KHR_node_visibility")) {
        node.visible = visibility->value("visible", true);
    }
    if (!typed.weights.empty() && typed.mesh >= 0) {
        const size_t targets = scene.meshes[static_cast<size_t>(typed.mesh)].weights.size();
        if (typed.weights.size() != targets) {
            throw refusal("node {} has {} weights for the {} morph targets of its mesh", index,
                          typed.weights.size(), targets);
        }
        node.weights.resize(targets);
        std::transform(typed.weights.begin(), typed.weights.end(), node.weights.begin(),
                       [](double weight) { return static_cast<float>(weight); });
    }
    if (const nlohmann::json* instancing = extension(description, "EXT_mesh_gpu_instancing");
        instancing != nullptr && node.mesh != k_none) {
        node.instances = read_instances(*instancing, accessors, source, index);
    }
    return node;
}

void set_parents(Scene& scene) {
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        for (const int child : scene.nodes[i].children) {
            int& parent = scene.nodes[static_cast<size_t>(child)].parent;
            if (parent != k_none) {
                throw refusal("node {} has two parents, {} and {}", child, parent, i);
            }
            parent = static_cast<int>(i);
        }
    }
}

// Nodes below the given ones, parents first. Each node has one parent, so none is met twice.
std::vector<int> parents_first(const Scene& scene, const std::vector<int>& roots) {
    std::vector<int> order;
    order.reserve(scene.nodes.size());
    std::vector<int> open(roots.rbegin(), roots.rend());
    while (!open.empty()) {
        const int index = open.back();
        open.pop_back();
        order.push_back(index);
        const std::vector<int>& children = scene.nodes[static_cast<size_t>(index)].children;
        open.insert(open.end(), children.rbegin(), children.rend());
    }
    return order;
}

std::vector<int> parentless(const Scene& scene) {
    std::vector<int> result;
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        if (scene.nodes[i].parent == k_none) {
            result.push_back(static_cast<int>(i));
        }
    }
    return result;
}

// What no root reaches, each node having one parent at most, goes round in a circle.
void require_no_cycle(const Scene& scene) {
    const std::vector<int> reached = parents_first(scene, parentless(scene));
    if (reached.size() == scene.nodes.size()) {
        return;
    }
    std::vector<bool> seen(scene.nodes.size(), false);
    for (const int index : reached) {
        seen[static_cast<size_t>(index)] = true;
    }
    const auto first = std::find(seen.begin(), seen.end(), false) - seen.begin();
    throw refusal("its node graph is cyclic: node {} is its own ancestor or below one that is", first);
}

std::vector<int> shown_roots(const Source& source, const Scene& scene) {
    const std::vector<tinygltf::Scene>& scenes = source.model.scenes;
    if (scenes.empty()) {
        return parentless(scene);
    }
    std::vector<int> roots = scenes[static_cast<size_t>(std::max(source.model.defaultScene, 0))].nodes;
    std::vector<int> sorted = roots;
    std::sort(sorted.begin(), sorted.end());
    if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end()) {
        throw refusal("its scene lists node {} twice", *twice);
    }
    for (const int root : roots) {
        if (scene.nodes[static_cast<size_t>(root)].parent != k_none) {
            throw refusal("its scene lists node {}, which is not a root but a child of node {}", root,
                          scene.nodes[static_cast<size_t>(root)].parent);
        }
    }
    return roots;
}

}  // namespace

void read_nodes(Source& source, const Accessors& accessors, Scene& scene) {
    scene.nodes.reserve(source.model.nodes.size());
    for (size_t i = 0; i < source.model.nodes.size(); ++i) {
        scene.nodes.push_back(read_node(source, accessors, scene, i));
    }
    set_parents(scene);
    require_no_cycle(scene);
    scene.roots = shown_roots(source, scene);
    scene.topological_order = parents_first(scene, scene.roots);
}

}  // namespace bounce::scene::gltf
