// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/avg_grid.h"
#include "passes/ism.h"
#include "passes/vpl_maps.h"

namespace bounce::passes {

struct AvgTraceInputs {
    AvgGrid grid;
    AvgHits hits = AvgHits::slabs;
    AvgPaths paths = AvgPaths::roulette;
    // vec4, `sequences` of as many low-discrepancy numbers; one for each ray at least.
    const gl::Buffer* numbers = nullptr;
    int sequences = 1;
    int bounce = 0;      // which of the sequences, and, where there are more bounces, how it is turned
    bool glossy = true;  // glossy reflection is kept
    ContentKey rays{};   // of the lights' rays, where they are traced
};

// Virtual point lights where rays meet the grid (Bashford-Rogers et al. 2012, III.B), with the flux of their
// rays; dark ones where a ray leaves it. `layout` says how many and where they go. Of rays from the scene's
// lights (GpuAvgRay, layout.maps of them).
[[nodiscard]] VplSet add_vpls_from_rays(FrameGraph& graph, const PassContext& context,
                                        const AvgTraceInputs& inputs, const gl::Buffer& rays, VplSet layout);
// Of rays from the lights of the bounce before.
[[nodiscard]] VplSet add_vpls_from_avg(FrameGraph& graph, const PassContext& context,
                                       const AvgTraceInputs& inputs, const VplSet& before, VplSet layout);

}  // namespace bounce::passes
