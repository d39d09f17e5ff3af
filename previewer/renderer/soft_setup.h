// SPDX-License-Identifier: Apache-2.0
//
// The maps of a light with a size: one from each of some places on it. Arithmetic without OpenGL.
#pragma once

#include <vector>

#include "gpu/shared_types.h"
#include "renderer/light_setup.h"
#include "renderer/receivers.h"

namespace bounce {

// One picture of a map; a map has one layer, or six of a cube.
struct SoftFace {
    int layer = 0;
    LightFace view;
};

struct SoftSetup {
    int map_kind = 0;                       // MAP_*
    int size = 0;                           // texels a side
    int layers = 0;                         // of all maps
    std::vector<gpu::GpuShadowView> views;  // one a sample, of equal weight
    std::vector<SoftFace> faces;            // those that receivers are seen in
    bool begins_near = false;               // what lies before the near planes hides nothing
};

// `samples` places on a light that is no sun, relative to its middle, render space; one is the middle itself.
[[nodiscard]] std::vector<glm::dvec3> place_offsets(const LightSetup& setup, const scene::Light& light,
                                                    int samples);

// What of the light's image each of them sends (light_tints()); the light is an area light with one.
[[nodiscard]] std::vector<glm::vec3> place_tints(const LightSetup& setup, const scene::Light& light,
                                                 int samples);

// Maps that hold what lies between the light and the receivers, fitted to them: `samples` of them, a power of
// two and a multiple of SHADOW_VIEW_CHUNK, each `size` texels a side (a cube's faces have half of it). One
// picture is enough where all receivers are seen within it; a light among them takes a cube. all: around the
// whole scene. One sample is the light's middle, whose map reaches somewhat beyond what receivers see in it:
// for the convolution of its surroundings.
[[nodiscard]] SoftSetup set_up_soft_shadow(const LightSetup& setup, const scene::Light& light,
                                           const std::vector<Region>& receivers, const gpu::DrawBox& all,
                                           int samples, int size);

}  // namespace bounce
