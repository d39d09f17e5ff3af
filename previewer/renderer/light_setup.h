// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/render_space.h"
#include "gpu/shared_types.h"
#include "scene/pose.h"

namespace bounce {

// One view of a light's maps.
struct LightFace {
    glm::mat4 clip_from_render{1.0F};
    bool mirrored = false;  // turns front faces into back faces
};

struct LightSetup {
    std::string name;
    int map_kind = 0;
    int profile = 0;
    gpu::GpuLight gpu{};
    std::vector<LightFace> faces;
    bool casts_shadow = true;
    double flux_w = 0.0;      // luminance-weighted, as sent out
    uint32_t place_seed = 0;  // of the places on it that throw its soft shadow (light_samples())
};

// A light as the shaders see it. Laws of Cycles as in docs/lights.md. rsm_size and shadow_size are those of
// a planar map; a cube's faces get half.
[[nodiscard]] LightSetup set_up_light(const scene::LightInstance& instance, const scene::Light& light,
                                      const scene::Bounds& bounds, const gpu::RenderSpace& space,
                                      int rsm_size, int shadow_size);

// How many of `total` samples each light gets: by flux, in steps of half an octave, so that a light that
// brightens slowly does not change its pattern, and with it the picture, in every frame; the sum is near
// `total`. None below a sixteenth of its even share's worth, so that a dim light near the view keeps a
// picture.
[[nodiscard]] std::vector<int> share_samples(const std::vector<double>& fluxes, int total);

}  // namespace bounce
