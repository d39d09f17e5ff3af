// SPDX-License-Identifier: Apache-2.0
//
// Pictures of virtual point lights and of their shadow maps, for people.
#pragma once

#include <vector>

#include "passes/gbuffer.h"
#include "passes/ism.h"

namespace bounce::passes {

// A bounce's lights as dots; bounce counts from 1 and chooses the rim's colour.
struct VplDots {
    VplSet set;
    int bounce = 1;
    int only = -1;  // this light alone; -1: all
};

// The picture dimmed, so that dots stand out from it.
[[nodiscard]] TextureHandle add_dimmed(FrameGraph& graph, const PassContext& context, TextureHandle target);

// A dot over the picture for each light: inside the colour that it sends out, around it its bounce's (orange,
// blue, pink, green). Lights behind what the camera sees are smaller and dimmer.
TextureHandle add_vpl_dots(FrameGraph& graph, const PassContext& context, const GBuffer& gbuffer,
                           const View& camera, const std::vector<VplDots>& dots, TextureHandle target);

// An atlas of shadow maps, fitted into the picture, the first map in the upper left: squared distance as grey
// (1: the scene's diagonal), blue where a map is empty. only: this map alone; -1: all.
TextureHandle add_ism_view(FrameGraph& graph, const PassContext& context, const VplSet& set,
                           TextureHandle atlas, int only, TextureHandle target);

// What one light's map leaves lit, in yellow; blue what it hides, grey where the light sends nothing anyway.
// Without an atlas nothing is hidden. slope_bias: the maps' splats have one depth each.
TextureHandle add_vpl_visibility_view(FrameGraph& graph, const PassContext& context, const GBuffer& gbuffer,
                                      const VplSet& set, bool slope_bias, int light, TextureHandle target);

}  // namespace bounce::passes
