// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "passes/gbuffer.h"
#include "passes/vpl_map_source.h"

namespace bounce::passes {

// Pixels that lights are judged by, and what a light counts for that shows in none of them
// (shaders/passes/vpl_importance.comp).
struct ImportanceView {
    GBuffer gbuffer;
    int pixels = 0;
    float floor = 0.0F;
    uint32_t seed = 0;  // 0: always the same pixels
};

// What each texel of all maps counts for, float, map after map, row after row: the flux it reflects, in the
// maps' own units, or, with a view, the luminance that the picture shows of it, unhidden (Barak, Bittner and
// Havran 2013, "Temporally Coherent Adaptive Sampling for Imperfect Shadow Maps", section 4.1).
// lights: how many are to be drawn, which decides what each stands for. of: what follows passes' names.
[[nodiscard]] BufferHandle add_vpl_importance(FrameGraph& graph, const PassContext& context,
                                              const std::vector<MapSource>& sources,
                                              const std::optional<ImportanceView>& view, int lights,
                                              const std::string& of = "");

// Buffers that samplers read: importance of each texel of all maps (invalid where it is the flux as the maps
// have it), running sums over all rows, and within each row.
struct ImportanceTables {
    BufferHandle importance;
    BufferHandle rows;
    BufferHandle texels;
};
// even_rows: half of the weight is shared out evenly among rows (shaders/passes/vpl_scan.comp).
[[nodiscard]] ImportanceTables add_importance_sums(FrameGraph& graph, const PassContext& context,
                                                   const std::vector<MapSource>& sources,
                                                   BufferHandle importance, const std::string& of,
                                                   bool even_rows);

// Makes a shader read texels' importance from the map instead of from the reflective map.
void read_importance_map(gl::Defines& defines);
void bind_importance_map(const PassResources& resources, BufferHandle importance, int first_texel);

}  // namespace bounce::passes
