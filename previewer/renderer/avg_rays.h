// SPDX-License-Identifier: Apache-2.0
//
// Rays that carry the light of the scene's lights into the approximate visibility grid (Bashford-Rogers et
// al. 2012, III.B): from places on each light, in directions distributed as what it sends. Arithmetic without
// OpenGL.
#pragma once

#include <span>
#include <vector>

#include "renderer/ism_layout.h"
#include "renderer/light_setup.h"
#include "scene/scene.h"

namespace bounce {

struct AvgRayLight {
    LightSetup setup;
    scene::LightPattern pattern;  // an area light's image; empty where it has none
};

// One ray for each of the layout's lights, in their order, so that every subset of the interleaved gather has
// rays of all lights in all directions. A light has as many as its part of the flux, one at least where there
// are enough, and they share out its flux (W in render-space units, through the scene's cross-section for a
// sun), which thereby is kept exactly. The same for the same lights: nothing depends on chance or the frame.
// Rays of lights that send nothing, or without any light, have no flux.
[[nodiscard]] std::vector<gpu::GpuAvgRay> avg_rays(std::span<const AvgRayLight> lights,
                                                   const IsmLayout& layout);

// Numbers in [0, 1)^4 for where rays go on: of each of k_avg_sequences bounces `count` of them. The first two
// are a point of the Halton sequence in two bases of the bounce's own, none of them the 2 of the lights'
// rays: in one base, where a path turns to would depend on where it came from.
constexpr int k_avg_sequences = 4;
[[nodiscard]] std::vector<glm::vec4> avg_numbers(int count);

// Flux of a light's rays, rgb.
[[nodiscard]] glm::dvec3 avg_flux(const LightSetup& light);

}  // namespace bounce
