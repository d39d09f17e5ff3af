// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/gbuffer.h"
#include "passes/ism.h"

namespace bounce::passes {

// How much of a light with a size each pixel sees.
struct SoftShadow {
    TextureHandle
        shares;  // RG32F: light that arrives, and that would without a shadow; where a tile has a penumbra.
                 // Of a light with tints RGBA32F: what arrives in each channel, and what would in the mean
    BufferHandle flags;  // a tile: 1 lit, 2 in full shadow, 3 penumbra, 0 nothing to be lit; invalid where
                         // shares are everywhere
};

// The maps of light.soft, which must not be empty: a layer each, or six of a cube.
[[nodiscard]] TextureHandle add_soft_maps(FrameGraph& graph, const PassContext& context,
                                          const LightPass& light);

// light_defines(), and SOFT_KIND.
[[nodiscard]] gl::Defines soft_defines(const LightPass& light);

// What a G-buffer's surfaces see of the light. Only tiles of 8 x 8 pixels whose maps do not all agree
// ask every map.
[[nodiscard]] SoftShadow add_soft_shadow(FrameGraph& graph, const PassContext& context,
                                         const GBuffer& gbuffer, const LightPass& light, TextureHandle maps);

// Imperfect shadow maps of places on a light with a size (Ritschel et al. 2008, 5.1).
struct ImperfectMaps {
    VplSet set;               // of the maps, whose lights are the places
    int places = 0;           // a multiple of SHADOW_VIEW_CHUNK, a power of two; the first lights of the set
    bool slope_bias = false;  // the maps' splats have one depth each
    [[nodiscard]] bool empty() const { return places == 0; }
};

// add_soft_shadow() by imperfect maps, whose set has its atlas.
[[nodiscard]] SoftShadow add_imperfect_shadow(FrameGraph& graph, const PassContext& context,
                                              const GBuffer& gbuffer, const LightPass& light,
                                              const ImperfectMaps& maps);

}  // namespace bounce::passes
