// SPDX-License-Identifier: Apache-2.0
#include "scene/points/point_materials.h"

#include <algorithm>
#include <optional>

#include "scene/points/texture_reader.h"
#include "scene/transparency.h"

namespace bounce::scene {
namespace {

size_t at(int index) {
    return static_cast<size_t>(index);
}

const Primitive& primitive_of(const Scene& scene, const SurfaceParts& parts, const PointSample& point) {
    const PointSurface& surface = parts.surfaces[point.surface];
    return scene.meshes[at(surface.mesh)].primitives[at(surface.primitive)];
}

glm::vec4 vertex_color(const Primitive& primitive, const PointSample& point) {
    if (primitive.colors.empty()) {
        return glm::vec4(1.0F);
    }
    const glm::uvec3& corner = point.triangle;
    return primitive.colors[corner.x] * (1.0F - point.second - point.third) +
           primitive.colors[corner.y] * point.second + primitive.colors[corner.z] * point.third;
}

// Between 0 and 1, never either: of consecutive numbers evenly spread, as the points are over surfaces.
float threshold(uint32_t number) {
    const uint32_t golden = 0x9E3779B9U;  // of 2^32
    return (static_cast<float>((number * golden) >> 8U) + 0.5F) / 16777216.0F;
}

}  // namespace

std::vector<PointMaterial> point_materials(const Scene& scene, const SurfaceParts& parts,
                                           const std::vector<PointSample>& points) {
    TextureReader reader(scene);
    std::vector<PointMaterial> out;
    out.reserve(points.size());
    for (const PointSample& point : points) {
        const Primitive& primitive = primitive_of(scene, parts, point);
        PointMaterial& material = out.emplace_back();
        material.base_color = glm::vec3(vertex_color(primitive, point));
        if (primitive.material == k_none) {
            continue;
        }
        const Material& source = scene.materials[at(primitive.material)];
        const float share = std::min(point.share, 1.0F);
        if (const auto color = reader.read(source.base_color_texture, primitive, point, share, true)) {
            material.base_color *= glm::vec3(*color);
        }
        if (const auto mr = reader.read(source.metallic_roughness_texture, primitive, point, share, false)) {
            material.roughness = mr->g;
            material.metallic = mr->b;
        }
    }
    return out;
}

std::vector<glm::vec3> point_emissions(const Scene& scene, const SurfaceParts& parts,
                                       const std::vector<PointSample>& points, TextureReader& reader) {
    std::vector<glm::vec3> out;
    out.reserve(points.size());
    for (const PointSample& point : points) {
        const Primitive& primitive = primitive_of(scene, parts, point);
        glm::vec3& emission = out.emplace_back(1.0F);
        if (primitive.material == k_none) {
            continue;
        }
        const Material& material = scene.materials[at(primitive.material)];
        if (const auto texture =
                reader.read(material.emission_texture, primitive, point, std::min(point.share, 1.0F), true)) {
            emission = glm::vec3(*texture);
        }
    }
    return out;
}

void drop_cut_out(const Scene& scene, const SurfaceParts& parts, std::vector<PointSample>& points) {
    TextureReader reader(scene);
    uint32_t number = 0;
    for (PointSample& point : points) {
        const Primitive& primitive = primitive_of(scene, parts, point);
        if (primitive.material == k_none) {
            continue;
        }
        const Material& material = scene.materials[at(primitive.material)];
        if (material.alpha_mode == AlphaMode::opaque) {
            continue;
        }
        float alpha = material.base_color.a * vertex_color(primitive, point).a;
        if (const auto color = reader.read(material.base_color_texture, primitive, point, 0.0F, true)) {
            alpha *= color->a;
        }
        // Of a blended surface a part alpha of the points stays.
        const float cutoff =
            material.alpha_mode == AlphaMode::blend ? threshold(number) : material.alpha_cutoff;
        ++number;
        if (alpha < cutoff) {
            point.share = 0.0F;
        }
    }
}

}  // namespace bounce::scene
