// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/vpl_sampling.h"

namespace bounce::passes {

// Cells of the sphere around the scene, row by row as an equirectangular image has them
// (shaders/lib/sphere.glsl).
struct SphereSource {
    const gl::Buffer* cells = nullptr;
    ContentKey content;                // of the cells
    gpu::UniformArena::Slot uniforms;  // SphereUniforms
    int width = 0;
    int height = 0;
    // The last light of each subset of several stands for a sun of the image, and stays as it is.
    bool has_suns = false;
};

// The world's lights at infinity, chosen among the sphere's cells as those of a first bounce are among the
// texels of reflective shadow maps (Barak, Bittner and Havran 2013, Table 1: "VPLs are generated on the
// sphere to simulate environment map lighting"). A sampling of cells of flux, or of none of these texels,
// counts as inverse2. set: with its buffer, in which the maps' places are filled in; returns it with another
// one.
[[nodiscard]] VplSet add_vpls_from_sphere(FrameGraph& graph, const PassContext& context,
                                          const SphereSource& sphere, VplSet set, const Drawing& drawing);

}  // namespace bounce::passes
