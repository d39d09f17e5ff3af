// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/vpl_importance.h"
#include "passes/vpl_maps.h"

namespace bounce::passes {

// How lights are chosen among the texels: one of the samplings that is_chosen() names.
struct Choosing {
    VplSampling sampling = VplSampling::inverse3;
    int lights = 0;
    int steps = 1;      // proposals of a chain, the first included
    uint32_t seed = 0;  // 0: always the same numbers
};

// A texel for each light: uvec4 of the source's number, the texel's among the source's, and how many texels
// the light is worth and how many lie around it with no other light (float bits; 0 where nothing is to be
// had). Each is an unbiased estimate of the sum over all texels, but for Metropolis' at a finite length of
// chain; shaders/passes/vpl_choose.comp has the methods and their sources.
[[nodiscard]] BufferHandle add_vpl_choice(FrameGraph& graph, const PassContext& context,
                                          const std::vector<MapSource>& sources,
                                          const ImportanceTables& tables, const Choosing& choosing,
                                          const std::string& of = "");

}  // namespace bounce::passes
