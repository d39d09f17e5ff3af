// SPDX-License-Identifier: Apache-2.0
#include "renderer/world_lights.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "scene/points/sobol.h"

namespace bounce {
namespace {

constexpr uint32_t k_seed = 0x57a125U;

// Equal areas of the square are equal solid angles.
glm::dvec3 on_sphere(double u, double v) {
    const double z = 1.0 - 2.0 * u;
    const double r = std::sqrt(std::max(1.0 - z * z, 0.0));
    const double phi = 2.0 * std::numbers::pi * v;
    return {r * std::cos(phi), r * std::sin(phi), z};
}

}  // namespace

std::vector<gpu::GpuVpl> world_lights(const glm::vec3& radiance, const IsmLayout& layout,
                                      const DistantMaps& maps) {
    std::vector<gpu::GpuVpl> lights(static_cast<size_t>(layout.vpls));
    const double solid_angle = 4.0 * std::numbers::pi / layout.vpls;
    for (int i = 0; i < layout.vpls; ++i) {
        const glm::dvec3 u = scene::sobol_point(static_cast<uint32_t>(i), k_seed);
        const glm::dvec3 way = on_sphere(u.x, u.y);
        // Turned about the way by the third coordinate, so that the texels of different maps do not line up.
        const glm::dvec3 other = std::abs(way.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
        const glm::dvec3 s = glm::normalize(glm::cross(other, way));
        const glm::dvec3 t = glm::cross(way, s);
        const double turn = 2.0 * std::numbers::pi * u.z;
        const glm::dvec3 tangent = std::cos(turn) * s + std::sin(turn) * t;
        const auto column = static_cast<uint32_t>(i % layout.columns * layout.map_size);
        const auto row = static_cast<uint32_t>(i / layout.columns * layout.map_size);
        gpu::GpuVpl& light = lights[static_cast<size_t>(i)];
        light.position = glm::vec4(maps.center, static_cast<float>(solid_angle));
        light.normal = glm::vec4(glm::vec3(way), 1.0F);
        light.tangent = glm::vec4(glm::vec3(tangent), maps.reach);
        light.bitangent =
            glm::vec4(glm::vec3(glm::cross(way, tangent)), std::bit_cast<float>(column | row << 16U));
        light.intensity = glm::vec4(radiance * static_cast<float>(solid_angle), 0.0F);
        light.incident = glm::vec4(glm::vec3(way), 1.0F);
        light.glossy = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
        light.arriving = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
    }
    return lights;
}

}  // namespace bounce
