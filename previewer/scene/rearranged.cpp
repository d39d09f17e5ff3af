// SPDX-License-Identifier: Apache-2.0
#include "scene/rearranged.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

#include "scene/geometry_tools.h"
#include "scene/pose.h"
#include "scene/primitive_bounds.h"

namespace bounce::scene {
namespace {

size_t at(int index) {
    return static_cast<size_t>(index);
}

// Of the primitive the triangles [first, end), with the vertices they need, in their order.
Primitive part_of(const Primitive& whole, size_t first, size_t end) {
    std::vector<uint32_t> vertices(whole.indices.begin() + static_cast<std::ptrdiff_t>(3 * first),
                                   whole.indices.begin() + static_cast<std::ptrdiff_t>(3 * end));
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    Primitive out = gather_vertices(whole, vertices);
    out.indices.clear();
    for (size_t i = 3 * first; i < 3 * end; ++i) {
        const auto found = std::lower_bound(vertices.begin(), vertices.end(), whole.indices[i]);
        out.indices.push_back(static_cast<uint32_t>(found - vertices.begin()));
    }
    out.bounds = primitive_bounds(out);
    return out;
}

std::vector<int> parents_first(const Scene& scene) {
    std::vector<int> order;
    std::vector<int> open(scene.roots.rbegin(), scene.roots.rend());
    while (!open.empty()) {
        const int index = open.back();
        open.pop_back();
        order.push_back(index);
        const std::vector<int>& children = scene.nodes[at(index)].children;
        open.insert(open.end(), children.rbegin(), children.rend());
    }
    return order;
}

// Adds to each animation what it does to the weights of one node for another.
void copy_weight_channels(Scene& scene, int from, int to) {
    for (Animation& animation : scene.animations) {
        for (size_t c = 0, count = animation.channels.size(); c < count; ++c) {
            AnimationChannel channel = animation.channels[c];
            if (channel.property == Property::node_weights && channel.index == from) {
                channel.index = to;
                animation.channels.push_back(channel);
            }
        }
    }
}

bool moves(Property property) {
    return property == Property::node_translation || property == Property::node_rotation ||
           property == Property::node_scale || property == Property::node_visible;
}

// Nodes that no animation moves, shows or hides, nor a node above them.
std::vector<bool> standing(const Scene& scene) {
    std::vector<bool> still(scene.nodes.size(), false);
    std::set<int> moving;
    for (const Animation& animation : scene.animations) {
        for (const AnimationChannel& channel : animation.channels) {
            if (moves(channel.property)) {
                moving.insert(channel.index);
            }
        }
    }
    for (const int index : scene.topological_order) {
        const Node& node = scene.nodes[at(index)];
        still[at(index)] =
            node.visible && !moving.contains(index) && (node.parent == k_none || still[at(node.parent)]);
    }
    return still;
}

bool same_streams(const Primitive& a, const Primitive& b) {
    return a.material == b.material && a.tangents.empty() == b.tangents.empty() &&
           a.uv0.empty() == b.uv0.empty() && a.uv1.empty() == b.uv1.empty() &&
           a.colors.empty() == b.colors.empty();
}

template <typename T>
void append(std::vector<T>& to, const std::vector<T>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

// The primitive as the transform places it. Its determinant is above 0.
Primitive placed(Primitive primitive, const glm::dmat4& matrix) {
    const glm::dmat3 linear(matrix);
    const glm::dmat3 of_normals = glm::transpose(glm::inverse(linear));
    for (glm::vec3& position : primitive.positions) {
        position = glm::vec3(matrix * glm::dvec4(glm::dvec3(position), 1.0));
    }
    for (glm::vec3& normal : primitive.normals) {
        normal = glm::vec3(glm::normalize(of_normals * glm::dvec3(normal)));
    }
    for (glm::vec4& tangent : primitive.tangents) {
        tangent = glm::vec4(glm::vec3(glm::normalize(linear * glm::dvec3(tangent))), tangent.w);
    }
    return primitive;
}

void join(Mesh& mesh, const Primitive& more) {
    const auto same = std::find_if(mesh.primitives.begin(), mesh.primitives.end(),
                                   [&](const Primitive& own) { return same_streams(own, more); });
    if (same == mesh.primitives.end()) {
        mesh.primitives.push_back(more);
        mesh.primitives.back().bounds = primitive_bounds(more);
        return;
    }
    const auto first = static_cast<uint32_t>(same->positions.size());
    append(same->positions, more.positions);
    append(same->normals, more.normals);
    append(same->tangents, more.tangents);
    append(same->uv0, more.uv0);
    append(same->uv1, more.uv1);
    append(same->colors, more.colors);
    for (const uint32_t index : more.indices) {
        same->indices.push_back(first + index);
    }
    same->bounds = primitive_bounds(*same);
}

bool joinable(const Mesh& mesh) {
    return std::all_of(mesh.primitives.begin(), mesh.primitives.end(), [](const Primitive& primitive) {
        return primitive.joints.empty() && primitive.targets.empty();
    });
}

// Index i of a list of `count` in the reverse list.
int reversed(int i, size_t count) {
    return i == k_none ? k_none : static_cast<int>(count) - 1 - i;
}

// Which list a property's index is into.
enum class Indexed { node, light, camera, material, none };

Indexed indexed(Property property) {
    if (property <= Property::node_visible) return Indexed::node;
    if (property <= Property::light_spread_rad) return Indexed::light;
    if (property <= Property::camera_shift_y) return Indexed::camera;
    if (property <= Property::material_emission_strength) return Indexed::material;
    return Indexed::none;
}

template <typename T>
void reverse(std::vector<T>& list) {
    std::reverse(list.begin(), list.end());
}

}  // namespace

Scene with_meshes_split(Scene scene) {
    std::vector<int> rest(scene.meshes.size(), k_none);  // of each mesh, its other half
    for (size_t m = 0; m < rest.size(); ++m) {
        Mesh first{scene.meshes[m].name, {}, scene.meshes[m].weights};
        Mesh second{scene.meshes[m].name + ", rest", {}, scene.meshes[m].weights};
        for (const Primitive& primitive : scene.meshes[m].primitives) {
            const size_t triangles = primitive.indices.size() / 3;
            const size_t middle = triangles < 2 ? triangles : triangles / 2;
            first.primitives.push_back(part_of(primitive, 0, middle));
            if (middle < triangles) {
                second.primitives.push_back(part_of(primitive, middle, triangles));
            }
        }
        scene.meshes[m] = std::move(first);
        if (!second.primitives.empty()) {
            rest[m] = static_cast<int>(scene.meshes.size());
            scene.meshes.push_back(std::move(second));
        }
    }
    for (int index = 0, count = static_cast<int>(scene.nodes.size()); index < count; ++index) {
        const Node& whole = scene.nodes[at(index)];
        if (whole.mesh == k_none || rest[at(whole.mesh)] == k_none) {
            continue;
        }
        Node half;
        half.name = whole.name + ", rest";
        half.parent = index;
        half.mesh = rest[at(whole.mesh)];
        half.skin = whole.skin;
        half.weights = whole.weights;
        half.instances = whole.instances;
        const auto added = static_cast<int>(scene.nodes.size());
        scene.nodes[at(index)].children.push_back(added);
        scene.nodes.push_back(std::move(half));
        copy_weight_channels(scene, index, added);
    }
    scene.topological_order = parents_first(scene);
    return scene;
}

Scene with_meshes_merged(Scene scene) {
    std::vector<int> users(scene.meshes.size(), 0);
    for (const Node& node : scene.nodes) {
        if (node.mesh != k_none) {
            ++users[at(node.mesh)];
        }
    }
    const std::vector<bool> still = standing(scene);
    const Pose pose = evaluate_pose(scene, 0.0);
    int first = k_none;
    for (const int index : scene.topological_order) {
        Node& node = scene.nodes[at(index)];
        if (!still[at(index)] || node.mesh == k_none || node.skin != k_none || !node.instances.empty() ||
            users[at(node.mesh)] != 1 || !joinable(scene.meshes[at(node.mesh)])) {
            continue;
        }
        const glm::dmat4& world = pose.world_from_node[at(index)];
        if (!(std::abs(glm::determinant(world)) > 0.0)) {
            continue;
        }
        if (first == k_none) {
            first = index;
            continue;
        }
        const glm::dmat4 first_from_node = glm::inverse(pose.world_from_node[at(first)]) * world;
        if (glm::determinant(first_from_node) < 0.0) {  // would turn the triangles over
            continue;
        }
        Mesh& joined = scene.meshes[at(scene.nodes[at(first)].mesh)];
        for (const Primitive& primitive : scene.meshes[at(node.mesh)].primitives) {
            join(joined, placed(primitive, first_from_node));
        }
        node.mesh = k_none;
        first = k_none;
    }
    return scene;
}

Scene reordered(const Scene& scene) {
    Scene out = scene;
    const auto node_of = [&](int& index) { index = reversed(index, scene.nodes.size()); };
    reverse(out.nodes);
    reverse(out.meshes);
    reverse(out.lights);
    reverse(out.cameras);
    reverse(out.materials);
    reverse(out.textures);
    reverse(out.images);
    for (Node& node : out.nodes) {
        node_of(node.parent);
        for (int& child : node.children) {
            node_of(child);
        }
        reverse(node.children);
        node.mesh = reversed(node.mesh, scene.meshes.size());
        node.light = reversed(node.light, scene.lights.size());
        node.camera = reversed(node.camera, scene.cameras.size());
    }
    for (int& root : out.roots) {
        node_of(root);
    }
    reverse(out.roots);
    for (Skin& skin : out.skins) {
        for (int& joint : skin.joints) {
            node_of(joint);
        }
    }
    for (Mesh& mesh : out.meshes) {
        reverse(mesh.primitives);
        for (Primitive& primitive : mesh.primitives) {
            primitive.material = reversed(primitive.material, scene.materials.size());
        }
    }
    for (Material& material : out.materials) {
        for (TextureRef* ref : {&material.base_color_texture, &material.metallic_roughness_texture,
                                &material.normal_texture, &material.emission_texture}) {
            ref->texture = reversed(ref->texture, scene.textures.size());
        }
    }
    for (Texture& texture : out.textures) {
        texture.image = reversed(texture.image, scene.images.size());
    }
    for (Animation& animation : out.animations) {
        for (AnimationChannel& channel : animation.channels) {
            switch (indexed(channel.property)) {
                case Indexed::node:
                    node_of(channel.index);
                    break;
                case Indexed::light:
                    channel.index = reversed(channel.index, scene.lights.size());
                    break;
                case Indexed::camera:
                    channel.index = reversed(channel.index, scene.cameras.size());
                    break;
                case Indexed::material:
                    channel.index = reversed(channel.index, scene.materials.size());
                    break;
                case Indexed::none:
                    break;
            }
        }
    }
    node_of(out.active_camera_node);
    out.topological_order = parents_first(out);
    return out;
}

}  // namespace bounce::scene
