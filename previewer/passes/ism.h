// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/triangle_patches.h"
#include "passes/point_update.h"
#include "scene/points/point_set.h"

namespace bounce::passes {

// How points are drawn into imperfect shadow maps. In all a splat covers the solid angle of the area that its
// point stands for: squares that of the area turned face on, disks that of the area as it lies, somewhat
// enlarged (renderer/ism_layout.cpp).
enum class Splat {
    disks,    // oriented disks with the plane's depth at each texel, compute
    compute,  // squares of one depth, compute, atomic minimum
    points,   // squares of one depth, GL_POINTS and the depth test (Ritschel et al. 2008, 3.2)
    // The same, of points that tessellation makes on the triangles as they are drawn, so that none are stored
    // (Barak, Bittner and Havran 2013, "Temporally Coherent Adaptive Sampling for Imperfect Shadow
    // Maps", 5.2)
    tessellation,
    automatic,  // compute or tessellation, by the counts of triangles and splats (renderer/splat_choice.h)
};

// What pull-push does to a map drawn with one depth a splat.
enum class PullPush {
    off,
    fill,   // fills holes
    paper,  // and replaces what lies behind the pushed depths by more than the threshold
};

struct PullPushSettings {
    PullPush mode = PullPush::fill;
    int levels = 2;
    // Depths this near are averaged on the way up; farther off they are replaced on the way down. Render
    // units (the scene's extent is 1), at the finest level; each coarser one doubles them.
    float pull_threshold = 0.05F;
    float push_threshold = 0.05F;
};

// The virtual point lights of one bounce and where their maps are.
struct VplSet {
    BufferHandle vpls;
    TextureHandle atlas;               // invalid: they are not occluded
    gpu::UniformArena::Slot uniforms;  // IsmUniforms
    int maps = 0;
    int map_size = 0;  // texels
    int columns = 0;   // maps a row of the atlas
    int rows = 0;
    int points_a_map = 0;
    int interleave = 1;    // n: each pixel gathers from an n x n-th of the lights
    int subset = 0;        // lights in such a part
    int cell_columns = 1;  // of a subset's cells of the sampled square
    uint32_t seed = 0;     // 0: always the same lights; else others for every seed, each of the same power
    bool middle = false;   // with a seed: lights still are means of their cells, quieter and less exact
    float extent = 1.0F;   // the surface that bounds a light's kernel, in parts of the one it stands for
    bool image = false;    // those of the world's image: what they light has its reflection from the image
    bool distant = false;  // lights at infinity, with orthographic maps (renderer/world_lights.h)
    bool window = false;   // maps of a part of the hemisphere: places on a light (renderer/imperfect_setup.h)
    bool both_sides = false;  // the second half of the maps is of the hemispheres behind the first
};

// What tessellation spreads points on.
struct TessellatedPoints {
    gpu::TrianglePatches* patches = nullptr;
    double area = 0.0;  // that the points of one map stand for, squared render units
    gpu::PatchCover cover = gpu::PatchCover::all;
};

struct IsmInputs {
    ScenePoints scene;
    TessellatedPoints tessellated;  // where splat is tessellation
    int large_triangles = 0;
    Splat splat = Splat::disks;
    bool close = true;  // disks: bare places inside surfaces (shaders/lib/ism_close.glsl)
    PullPushSettings pull_push;
};

// How a set's maps are compiled in: DISTANT, WINDOW, BOTH_SIDES.
[[nodiscard]] gl::Defines map_defines(const VplSet& set);

// What decides on maps of the set, but for the lights themselves.
[[nodiscard]] ContentKey content(const PassContext& context, const VplSet& set);

// Imperfect shadow maps of a set of lights, in one atlas of R32UI (shaders/lib/ism.glsl).
struct IsmAtlas {
    TextureHandle splats;  // before pull-push; invalid where there is none
    TextureHandle atlas;
};
[[nodiscard]] IsmAtlas add_ism(FrameGraph& graph, const PassContext& context, const IsmInputs& inputs,
                               const VplSet& set);

}  // namespace bounce::passes
