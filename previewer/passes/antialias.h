// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/gbuffer.h"

namespace bounce::passes {

// Depth at AA_SAMPLES places of each pixel.
struct DepthSamples {
    TextureHandle depth;
};

// Of the solid surfaces.
[[nodiscard]] DepthSamples add_depth_samples(FrameGraph& graph, const PassContext& context,
                                             const View& camera);

// Of the blended surfaces next behind `before`, and before the solid ones; without `before`, of the first
// ones.
[[nodiscard]] DepthSamples add_peeled_samples(FrameGraph& graph, const PassContext& context,
                                              const View& camera, const DepthSamples& solid,
                                              TextureHandle before, const std::string& layer);

// Smooths the outlines of a picture that was shaded once a pixel, into `target`, an RGBA32F texture (invalid:
// a new one): each depth sample takes the colour of that pixel nearby whose surface it lies on, and samples
// are weighed by Cycles' own pixel filter (shaders/passes/antialias.comp). offset: where pixels look, from
// their middles, pixels. layer: of a picture of blended
// surfaces, radiance times alpha and alpha, its name.
[[nodiscard]] TextureHandle add_antialias(FrameGraph& graph, const PassContext& context,
                                          const GBuffer& gbuffer, const DepthSamples& samples,
                                          TextureHandle picture, TextureHandle target,
                                          const glm::vec2& offset, const std::string& layer = {});

}  // namespace bounce::passes
