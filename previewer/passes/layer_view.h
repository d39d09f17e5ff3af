// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/rsm_gather.h"
#include "passes/vpl_sampling.h"

namespace bounce::passes {

// Pictures of what is inside, for people.
enum class Layer { rsm_depth = 0, rsm_position = 1, rsm_normal = 2, rsm_flux = 3 };

// A light's RSM, fitted into the picture; a cube's faces side by side.
void add_rsm_layer_view(FrameGraph& graph, const PassContext& context, const RsmSource& source, Layer layer,
                        TextureHandle target);

// The importance map of one of the sources that lights are drawn from (Drawing::map), over the mean of all.
void add_importance_view(FrameGraph& graph, const PassContext& context, const std::vector<VplSource>& sources,
                         size_t shown, const VplImportance& importance, TextureHandle target);

// Red where the indirect light was evaluated in full, grey where it was interpolated.
void add_interpolation_view(FrameGraph& graph, const PassContext& context, const GBuffer& gbuffer,
                            TextureHandle irradiance, TextureHandle target);

}  // namespace bounce::passes
