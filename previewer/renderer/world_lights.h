// SPDX-License-Identifier: Apache-2.0
//
// The world as virtual point lights at infinity (Ritschel et al. 2008, 5.1).
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/shared_types.h"
#include "renderer/ism_layout.h"

namespace bounce {

// What the shadow maps of lights at infinity show: a cube along the light's way. Render units.
struct DistantMaps {
    glm::vec3 center{0.0F};
    float reach = 0.0F;  // half of the cube's side
};

// The world as cells of the sphere, row by row as an equirectangular image has them, in its own axes.
struct SphereCells {
    int width = 0;
    int height = 0;
    std::vector<glm::vec4> light;  // rgb: irradiance on a facing plane, W/m^2; w: solid angle
};
// Of one radiance, rgb, W/(m^2 sr).
[[nodiscard]] SphereCells even_cells(const glm::vec3& radiance);

constexpr uint32_t k_world_lights_seed = 0x57a125U;

// A unit vector across another, turned about it by an angle (radians).
[[nodiscard]] glm::dvec3 turned_tangent(const glm::dvec3& way, double turn);

// Number `index` of the layout's lights at infinity, still without light: it travels along the unit vector
// `way`, and `tangent` is the s axis of its map.
[[nodiscard]] gpu::GpuVpl distant_light(const glm::dvec3& way, const glm::dvec3& tangent, int index,
                                        const IsmLayout& layout, const DistantMaps& maps);

// Lights that together are a world of one radiance (rgb, W/(m^2 sr)): layout.vpls directions, each for the
// same solid angle, 4 pi in all; every subset of them is spread evenly over the sphere. normal is the way the
// light travels, position the middle of its map, position.w the solid angle, tangent.w the map's reach,
// intensity the radiance times the solid angle; maps stand in the layout's atlas. seed: another set for each.
[[nodiscard]] std::vector<gpu::GpuVpl> world_lights(const glm::vec3& radiance, const IsmLayout& layout,
                                                    const DistantMaps& maps, uint32_t seed = 0);

}  // namespace bounce
