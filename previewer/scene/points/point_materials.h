// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "scene/points/point_set.h"
#include "scene/points/texture_reader.h"

namespace bounce::scene {

// What textures and vertex colours say at a point; a material's factors are not in it, because they may be
// animated.
struct PointMaterial {
    glm::vec3 base_color{1.0F};  // linear
    float roughness = 1.0F;
    float metallic = 1.0F;
};

// One a point, averaged over the area that the point stands for.
[[nodiscard]] std::vector<PointMaterial> point_materials(const Scene& scene, const SurfaceParts& parts,
                                                         const std::vector<PointSample>& points);

// What the emission textures say at points, averaged over the area that each stands for, at most its
// triangle: linear, 1 where a material has none. One a point.
[[nodiscard]] std::vector<glm::vec3> point_emissions(const Scene& scene, const SurfaceParts& parts,
                                                     const std::vector<PointSample>& points,
                                                     TextureReader& reader);

// Takes the area away from points that lie where their surface's texture or material cuts a hole: they hide
// and reflect nothing.
void drop_cut_out(const Scene& scene, const SurfaceParts& parts, std::vector<PointSample>& points);

}  // namespace bounce::scene
