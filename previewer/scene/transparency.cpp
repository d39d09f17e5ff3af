// SPDX-License-Identifier: Apache-2.0
#include "scene/transparency.h"

#include <algorithm>

namespace bounce::scene {
namespace {

size_t at(int index) {
    return static_cast<size_t>(index);
}

bool texture_varies(const Scene& scene, const TextureRef& ref, const Primitive& primitive) {
    if (!ref.present() || (ref.uv_set == 0 ? primitive.uv0 : primitive.uv1).empty()) {
        return false;
    }
    const int image = scene.textures[at(ref.texture)].image;
    return image != k_none && !scene.images[at(image)].opaque;
}

bool colors_vary(const Primitive& primitive) {
    return std::any_of(primitive.colors.begin(), primitive.colors.end(),
                       [](const glm::vec4& color) { return color.a < k_alpha_solid; });
}

}  // namespace

Coverage coverage(const Scene& scene, const Material& material, const Primitive& primitive) {
    Coverage out;
    if (material.alpha_mode != AlphaMode::blend) {
        return out;
    }
    // Textures and colours of vertices only lower the factor.
    const float alpha = material.base_color.a;
    const bool varies =
        texture_varies(scene, material.base_color_texture, primitive) || colors_vary(primitive);
    out.visible = alpha >= k_alpha_nothing;
    out.solid = alpha >= k_alpha_solid;
    out.blended = out.visible && (varies || !out.solid);
    return out;
}

bool draws_blended(const Scene& scene, const Pose& pose) {
    return std::any_of(pose.draws.begin(), pose.draws.end(), [&](const DrawInstance& draw) {
        const std::vector<Primitive>& primitives = scene.meshes[at(draw.mesh)].primitives;
        return std::any_of(primitives.begin(), primitives.end(), [&](const Primitive& primitive) {
            return primitive.material != k_none && !primitive.indices.empty() &&
                   coverage(scene, pose.materials[at(primitive.material)], primitive).blended;
        });
    });
}

}  // namespace bounce::scene
