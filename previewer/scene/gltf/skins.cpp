// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "scene/gltf/nodes.h"

namespace bounce::scene::gltf {
namespace {

Skin read_skin(const Source& source, const Accessors& accessors, size_t index) {
    const tinygltf::Skin& typed = source.model.skins[index];
    Skin skin;
    skin.name = typed.name;
    skin.joints = typed.joints;
    if (skin.joints.empty() || skin.joints.size() > k_max_joints) {
        throw refusal("skin {} has {} joints; 1 to {} are allowed", index, skin.joints.size(), k_max_joints);
    }
    skin.joint_from_mesh.assign(skin.joints.size(), glm::mat4(1.0F));
    if (typed.inverseBindMatrices >= 0) {
        const auto matrices = accessors.vectors<glm::mat4>(typed.inverseBindMatrices);
        if (matrices.size() < skin.joints.size()) {
            throw refusal("skin {} has {} inverse bind matrices for {} joints", index, matrices.size(),
                          skin.joints.size());
        }
        std::copy_n(matrices.begin(), skin.joints.size(), skin.joint_from_mesh.begin());
    }
    for (glm::mat4& matrix : skin.joint_from_mesh) {
        for (glm::length_t column = 0; column < 4; ++column) {
            if (glm::any(glm::isnan(matrix[column])) || glm::any(glm::isinf(matrix[column]))) {
                throw refusal("skin {} has an inverse bind matrix that is not finite", index);
            }
            // glTF demands this row; files from quantising tools miss it by rounding.
            matrix[column].w = column == 3 ? 1.0F : 0.0F;
        }
    }
    return skin;
}

size_t joints_needed(const Primitive& primitive) {
    size_t most = 0;
    for (const glm::u16vec4& joints : primitive.joints) {
        most = std::max<size_t>(most, std::max({joints.x, joints.y, joints.z, joints.w}));
    }
    return most + 1;
}

void check_skinned_node(Source& source, Scene& scene, size_t index, const std::vector<size_t>& needed) {
    Node& node = scene.nodes[index];
    const Mesh& mesh = scene.meshes[static_cast<size_t>(node.mesh)];
    const auto has_joints = [](const Primitive& primitive) { return !primitive.joints.empty(); };
    if (std::none_of(mesh.primitives.begin(), mesh.primitives.end(), has_joints)) {
        source.warn(fmt::format("node {} has a skin, but its mesh no joints; it is shown rigid", index));
        node.skin = k_none;
        return;
    }
    if (!std::all_of(mesh.primitives.begin(), mesh.primitives.end(), has_joints)) {
        throw refusal("mesh {} is skinned, but some of its primitives have no joints", node.mesh);
    }
    const size_t joints = scene.skins[static_cast<size_t>(node.skin)].joints.size();
    if (needed[static_cast<size_t>(node.mesh)] > joints) {
        throw refusal("mesh {} refers to joint {}, and its skin {} has {}", node.mesh,
                      needed[static_cast<size_t>(node.mesh)] - 1, node.skin, joints);
    }
}

}  // namespace

void read_skins(Source& source, const Accessors& accessors, Scene& scene) {
    for (size_t i = 0; i < source.model.skins.size(); ++i) {
        scene.skins.push_back(read_skin(source, accessors, i));
    }
    std::vector<size_t> needed(scene.meshes.size(), 0);
    for (size_t i = 0; i < scene.meshes.size(); ++i) {
        for (const Primitive& primitive : scene.meshes[i].primitives) {
            needed[i] = std::max(needed[i], primitive.joints.empty() ? 0 : joints_needed(primitive));
        }
    }
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        if (scene.nodes[i].skin != k_none) {
            check_skinned_node(source, scene, i, needed);
        }
    }
}

}  // namespace bounce::scene::gltf
