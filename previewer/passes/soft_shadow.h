// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/gbuffer.h"

namespace bounce::passes {

// How much of a light with a size each pixel sees.
struct SoftShadow {
    TextureHandle
        shares;  // RG32F: light that arrives, and that would without a shadow; where a tile has a penumbra
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

}  // namespace bounce::passes
