// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "passes/ism.h"
#include "passes/vpl_importance.h"
#include "passes/vpl_maps.h"

namespace bounce::passes {

// A light and its reflective shadow map.
struct VplSource {
    LightPass light;
    TextureHandle rsm;
};

// Imperfect reflective shadow maps of a bounce's lights: what the next bounce's are drawn from.
struct IrsmSource {
    VplSet set;           // whose lights they are; its uniforms and map size are those of the maps to read
    TextureHandle irsm;   // as add_irsm() draws them; invalid: the points themselves
    TextureHandle atlas;  // the lights' shadow maps, which hide points where there is no irsm; may be invalid
    bool slope_bias = false;  // the shadow maps' splats have one depth each
    ScenePoints scene;
    const gpu::PointStore* store = nullptr;
};

// Running sums of importance over all rows of all maps that lights were drawn from.
struct VplImportance {
    BufferHandle rows;
    int row_count = 0;
    BufferHandle
        map;  // of each texel (passes/vpl_importance.h); invalid where it is the flux as the maps have it
    // Texels that a light around a texel stands for are the weighed mean of how many that is where lights lie
    // evenly, per source, and of what its importance makes it. even_part: weight of the former, 1 for lights
    // that are drawn whatever their importance, 1/M for chains of M proposals (passes/vpl_choose.comp).
    std::vector<float> even;
    float even_part = 0.0F;
};

// How the lights of a first bounce are drawn.
struct Drawing {
    bool glossy = false;  // glossy reflection counts and is kept
    VplSampling sampling = VplSampling::inverse_transform;
    int steps = 1;                       // of a chain
    bool map = false;                    // the importance map is made whether it is needed or not
    std::optional<ImportanceView> view;  // importance is what the picture shows; else the flux reflected
};

// Virtual point lights (GpuVpl) drawn in proportion to the importance of the maps' texels; together they have
// all flux that the maps reflect. Without any all are dark. `layout` says how many and where they go; returns
// it with the buffer filled in. Sampling uniform: texels at the points of the two-dimensional Halton sequence
// instead, each with an equal part of the map; lights share its points in proportion to what they send out.
// The running sums are there all the same, for what reads them. passes/vpl_choice.h has the other samplings.
struct DrawnVpls {
    VplSet set;
    VplImportance importance;
};
[[nodiscard]] DrawnVpls add_vpls_from_rsms(FrameGraph& graph, const PassContext& context,
                                           const std::vector<VplSource>& sources, VplSet layout,
                                           const Drawing& drawing);
// The area that each of a set's lights stands for, from how densely they lie; the lights with it filled in.
// Of lights that were traced through a grid with these AvgUniforms.
[[nodiscard]] BufferHandle add_traced_spacing(FrameGraph& graph, const PassContext& context,
                                              const VplSet& set, gpu::UniformArena::Slot grid);
[[nodiscard]] DrawnVpls add_vpls_from_irsms(FrameGraph& graph, const PassContext& context,
                                            const IrsmSource& source, VplSet layout, bool glossy);

}  // namespace bounce::passes
