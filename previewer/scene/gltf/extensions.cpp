// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/extensions.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "scene/gltf/source.h"

namespace bounce::scene::gltf {
namespace {

// Read whole, or as far as a preview can show.
constexpr std::array k_read = std::to_array<std::string_view>({
    "BOUNCE_scene",
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_animation_pointer",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_specular",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_node_visibility",
    "KHR_texture_transform",
});

// Metadata that changes no picture: not worth a warning.
constexpr std::array k_silent = std::to_array<std::string_view>({"KHR_xmp_json_ld", "KHR_xmp"});

struct Consequence {
    std::string_view name;
    std::string_view text;
};

// Used but not carried, and what that does to the picture.
constexpr std::array k_not_carried = std::to_array<Consequence>({
    {"KHR_materials_transmission", "its surfaces are shown opaque"},
    {"KHR_materials_diffuse_transmission", "light does not pass through its surfaces"},
    {"KHR_materials_volume", "light is not absorbed inside its solids"},
    {"KHR_materials_volume_scatter", "light is not scattered inside its solids"},
    {"KHR_materials_clearcoat", "its coated surfaces are shown without their coat"},
    {"KHR_materials_sheen", "its fabrics are shown without sheen"},
    {"KHR_materials_dispersion", "glass does not split colours"},
    {"KHR_materials_iridescence", "its thin films show no interference colours"},
    {"KHR_materials_anisotropy", "its brushed surfaces are shown isotropic"},
    {"KHR_materials_variants", "the default variant is shown"},
    {"KHR_texture_basisu", "its fallback images are shown where there are any"},
    {"KHR_materials_pbrSpecularGlossiness", "its metallic-roughness fallback is shown"},
    {"EXT_lights_image_based", "its image light is left out"},
    {"MSFT_texture_dds", "its fallback images are shown"},
    {"MSFT_lod", "the finest level of detail is shown"},
});

template <size_t N>
bool contains(const std::array<std::string_view, N>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

void check_extensions(Source& source) {
    for (const nlohmann::json& item : list(source.json(), "extensionsRequired")) {
        const auto name = item.get<std::string>();
        if (!contains(k_read, name)) {
            throw refusal("it requires the extension {}, which is not supported", name);
        }
    }
    for (const nlohmann::json& item : list(source.json(), "extensionsUsed")) {
        const auto name = item.get<std::string>();
        if (contains(k_read, name) || contains(k_silent, name)) {
            continue;
        }
        const auto* known = std::find_if(k_not_carried.begin(), k_not_carried.end(),
                                         [&](const Consequence& entry) { return entry.name == name; });
        if (known != k_not_carried.end()) {
            source.warn(fmt::format("the extension {} is not supported: {}", name, known->text));
        } else {
            source.warn(fmt::format("the extension {} is not known and was passed over", name));
        }
    }
}

}  // namespace bounce::scene::gltf
