// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/materials.h"

#include <algorithm>

namespace bounce::scene::gltf {
namespace {

using nlohmann::json;

constexpr float k_default_specular = 0.5F;  // F0 = 0.04, as glTF's metallic-roughness model has it

AlphaMode alpha_mode_of(Source& source, const std::string& name) {
    if (name == "MASK") {
        return AlphaMode::mask;
    }
    if (name == "BLEND") {
        return AlphaMode::blend;
    }
    if (name != "OPAQUE") {
        source.warn(fmt::format("the alpha mode {} is not known; the material is shown opaque", name));
    }
    return AlphaMode::opaque;
}

// Normal reflectance of a dielectric in air. An index of 0 stands for infinity (KHR_materials_ior).
float reflectance_of_ior(float ior) {
    if (ior < 1.0F) {
        return 1.0F;
    }
    const float ratio = (ior - 1.0F) / (ior + 1.0F);
    return ratio * ratio;
}

// KHR_materials_ior and KHR_materials_specular, of which the factor alone can be carried, as
// Principled's "Specular".
float specular_of(Source& source, const json& description) {
    constexpr float reflectance_at_one = 0.08F;  // Principled: F0 = 0.08 * specular
    float specular = k_default_specular;
    if (const json* ior = extension(description, "KHR_materials_ior")) {
        specular = reflectance_of_ior(number_or(*ior, "ior", 1.5F)) / reflectance_at_one;
    }
    const json* lobe = extension(description, "KHR_materials_specular");
    if (lobe == nullptr) {
        return specular;
    }
    if (lobe->contains("specularTexture") || lobe->contains("specularColorTexture")) {
        source.warn("textures of KHR_materials_specular are not supported; their factor is used");
    }
    const json& tint = list(*lobe, "specularColorFactor");
    if (std::any_of(tint.begin(), tint.end(), [](const json& x) { return x.get<float>() != 1.0F; })) {
        source.warn(
            "the colour of KHR_materials_specular is not supported; reflections are shown uncoloured");
    }
    return specular * std::clamp(number_or(*lobe, "specularFactor", 1.0F), 0.0F, 1.0F);
}

// What Blender meant, where the file says so; the extensions above are then only its translation.
void read_reflection(Source& source, const json& description, Material& material) {
    const json* blender = extension(description, "BOUNCE_scene");
    if (blender == nullptr || !blender->contains("specular")) {
        material.specular = specular_of(source, description);
    }
    if (blender != nullptr) {
        const bool disney = string_or(*blender, "diffuse", "lambert") == "disney";
        material.diffuse = disney ? DiffuseModel::disney : DiffuseModel::lambert;
        material.specular = number_or(*blender, "specular", material.specular);
    }
}

Material read_material(Source& source, TextureTable& textures, size_t index) {
    const tinygltf::Material& typed = source.model.materials[index];
    const json& description = source.json()["materials"][index];
    Material material;
    material.name = typed.name;
    const auto& base = typed.pbrMetallicRoughness.baseColorFactor;
    material.base_color = glm::vec4(glm::dvec4(base[0], base[1], base[2], base[3]));
    material.metallic = std::clamp(static_cast<float>(typed.pbrMetallicRoughness.metallicFactor), 0.0F, 1.0F);
    material.roughness =
        std::clamp(static_cast<float>(typed.pbrMetallicRoughness.roughnessFactor), 0.0F, 1.0F);
    const auto& emissive = typed.emissiveFactor;
    material.emission = glm::vec3(glm::dvec3(emissive[0], emissive[1], emissive[2]));
    if (const json* strength = extension(description, "KHR_materials_emissive_strength")) {
        material.emission_strength = std::max(number_or(*strength, "emissiveStrength", 1.0F), 0.0F);
    }
    read_reflection(source, description, material);

    static const json none = json::object();
    const json* pbr = member(description, "pbrMetallicRoughness");
    const json& base_owner = pbr == nullptr ? none : *pbr;
    material.base_color_texture = textures.read(base_owner, "baseColorTexture");
    material.metallic_roughness_texture = textures.read(base_owner, "metallicRoughnessTexture");
    material.normal_texture = textures.read(description, "normalTexture");
    material.emission_texture = textures.read(description, "emissiveTexture");
    material.normal_scale = static_cast<float>(typed.normalTexture.scale);

    material.alpha_mode = alpha_mode_of(source, typed.alphaMode);
    material.alpha_cutoff = static_cast<float>(typed.alphaCutoff);
    material.double_sided = typed.doubleSided;
    material.unlit = extension(description, "KHR_materials_unlit") != nullptr;
    return material;
}

}  // namespace

void read_materials(Source& source, Buffers& buffers, Scene& scene) {
    TextureTable textures(source, buffers, scene);
    for (size_t i = 0; i < source.model.materials.size(); ++i) {
        scene.materials.push_back(read_material(source, textures, i));
    }
}

}  // namespace bounce::scene::gltf
