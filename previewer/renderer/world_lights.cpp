// SPDX-License-Identifier: Apache-2.0
#include "renderer/world_lights.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "scene/environment.h"
#include "scene/points/sobol.h"

namespace bounce {
namespace {

// Cells across, where all send the same: about as far apart as what a texel of a shadow map shows.
constexpr int k_even_cells = 128;

// Equal areas of the square are equal solid angles.
glm::dvec3 on_sphere(double u, double v) {
    const double z = 1.0 - 2.0 * u;
    const double r = std::sqrt(std::max(1.0 - z * z, 0.0));
    const double phi = 2.0 * std::numbers::pi * v;
    return {r * std::cos(phi), r * std::sin(phi), z};
}

}  // namespace

SphereCells even_cells(const glm::vec3& radiance) {
    SphereCells out{k_even_cells, k_even_cells / 2, {}};
    for (int y = 0; y < out.height; ++y) {
        const auto sr = static_cast<float>(scene::environment_texel_sr(out.width, out.height, y));
        out.light.insert(out.light.end(), static_cast<size_t>(out.width), glm::vec4(radiance * sr, sr));
    }
    return out;
}

glm::dvec3 turned_tangent(const glm::dvec3& way, double turn) {
    const glm::dvec3 other = std::abs(way.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 s = glm::normalize(glm::cross(other, way));
    const glm::dvec3 t = glm::cross(way, s);
    return std::cos(turn) * s + std::sin(turn) * t;
}

gpu::GpuVpl distant_light(const glm::dvec3& way, const glm::dvec3& tangent, int index,
                          const IsmLayout& layout, const DistantMaps& maps) {
    const auto column = static_cast<uint32_t>(index % layout.columns * layout.map_size);
    const auto row = static_cast<uint32_t>(index / layout.columns * layout.map_size);
    gpu::GpuVpl light{};
    light.position = glm::vec4(maps.center, 0.0F);
    light.normal = glm::vec4(glm::vec3(way), 1.0F);
    light.tangent = glm::vec4(glm::vec3(tangent), maps.reach);
    light.bitangent =
        glm::vec4(glm::vec3(glm::cross(way, tangent)), std::bit_cast<float>(column | row << 16U));
    light.intensity = glm::vec4(0.0F);
    light.incident = glm::vec4(glm::vec3(way), 1.0F);
    light.glossy = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
    light.arriving = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
    return light;
}

std::vector<gpu::GpuVpl> world_lights(const glm::vec3& radiance, const IsmLayout& layout,
                                      const DistantMaps& maps, uint32_t seed) {
    std::vector<gpu::GpuVpl> lights;
    const uint32_t scrambling = scene::numbered_seed(k_world_lights_seed, seed);
    const double solid_angle = 4.0 * std::numbers::pi / layout.vpls;
    for (int i = 0; i < layout.vpls; ++i) {
        const glm::dvec3 u = scene::sobol_point(static_cast<uint32_t>(i), scrambling);
        // Turned about the way by the third coordinate, so that the texels of different maps do not line up.
        const glm::dvec3 way = on_sphere(u.x, u.y);
        gpu::GpuVpl light =
            distant_light(way, turned_tangent(way, 2.0 * std::numbers::pi * u.z), i, layout, maps);
        light.position.w = static_cast<float>(solid_angle);
        light.intensity = glm::vec4(radiance * static_cast<float>(solid_angle), 0.0F);
        lights.push_back(light);
    }
    return lights;
}

}  // namespace bounce
