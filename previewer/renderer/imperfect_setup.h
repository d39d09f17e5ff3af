// SPDX-License-Identifier: Apache-2.0
//
// Imperfect shadow maps of places on a light with a size (Ritschel et al. 2008, 5.1): where they look from,
// and what of it they show. Arithmetic without OpenGL.
#pragma once

#include <vector>

#include "gpu/shared_types.h"
#include "renderer/ism_layout.h"
#include "renderer/light_setup.h"
#include "renderer/receivers.h"

namespace bounce {

struct ImperfectSetup {
    // One a map, without light of their own: the places in the order of light_samples(); where both_sides,
    // then their maps of the other hemisphere. incident.xyz: middle and half side of the part of the
    // parabolic disk that the map shows; incident.w: where the atlas has the place's other map, 16 bits each.
    std::vector<gpu::GpuVpl> maps;
    bool distant = false;     // of a sun: directions, with orthographic maps
    bool both_sides = false;  // receivers lie all around
};

// layout: for `places` maps, or twice as many where there are two a place (imperfect_maps_a_place()).
[[nodiscard]] ImperfectSetup set_up_imperfect_shadow(const LightSetup& setup, const scene::Light& light,
                                                     const std::vector<Region>& receivers, int places,
                                                     const IsmLayout& layout);

// 2 where a light has receivers on all its sides, so that no hemisphere holds them; 1 otherwise.
[[nodiscard]] int imperfect_maps_a_place(const LightSetup& setup, const scene::Light& light,
                                         const std::vector<Region>& receivers);

// Of `maps` such maps, and of so many points each.
[[nodiscard]] IsmLayout imperfect_layout(const Settings& settings, int maps, int points_a_map);

// ism_uniforms() of such maps.
[[nodiscard]] gpu::IsmUniforms imperfect_uniforms(const IsmLayout& layout, const Settings& settings,
                                                  size_t occluders, double mean_radius);

}  // namespace bounce
