// SPDX-License-Identifier: Apache-2.0
//
// The world as virtual point lights at infinity (Ritschel et al. 2008, 5.1).
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "gpu/shared_types.h"
#include "renderer/ism_layout.h"

namespace bounce {

// Lights that together are a world of one radiance (rgb, W/(m^2 sr)): layout.vpls directions, each for the same solid
// angle, 4 pi in all; every subset of them is spread evenly over the sphere. normal is the way the light travels,
// position.w the solid angle, intensity the radiance times it; maps stand in the layout's atlas.
[[nodiscard]] std::vector<gpu::GpuVpl> world_lights(const glm::vec3& radiance, const IsmLayout& layout);

}  // namespace bounce
