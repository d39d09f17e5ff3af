// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/pass_context.h"

namespace bounce::passes {

// The approximate visibility grid (Bashford-Rogers et al. 2012, "Approximate Visibility Grids for Interactive
// Indirect Illumination", III.A): of each voxel which surfaces are in it.
struct AvgGrid {
    gpu::UniformArena::Slot uniforms;  // AvgUniforms
    gpu::AvgUniforms layout{};
    TextureHandle cells;    // R32UI, a layer for each z: shaders/lib/avg.glsl
    BufferHandle surfaces;  // GpuAvgVoxel
    BufferHandle
        rows;  // running sums of the surfaces in each row along x, floats; the last: of all, room or not
    [[nodiscard]] bool valid() const { return surfaces.valid(); }
};

// Fills a grid that has its uniforms and layout, from the triangles as they are posed and deformed now. Every
// triangle with an area is in every voxel that it meets, but for what its material cuts out.
[[nodiscard]] AvgGrid add_avg_grid(FrameGraph& graph, const PassContext& context, AvgGrid grid);

// The grid's surfaces as the camera sees them: each voxel's as a piece of its plane, in its base colour,
// shaded by its normal.
void add_avg_view(FrameGraph& graph, const PassContext& context, const AvgGrid& grid, bool whole_voxels,
                  TextureHandle target);

}  // namespace bounce::passes
