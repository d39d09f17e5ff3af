// SPDX-License-Identifier: Apache-2.0
//
// Every binding point and size that C++ and GLSL must agree on. Compiled by both.
#ifndef BOUNCE_SHARED_BINDINGS_H
#define BOUNCE_SHARED_BINDINGS_H

// Uniform buffers.
#define UBO_FRAME 0
#define UBO_VIEW 1
#define UBO_LIGHT 2
#define UBO_ISM 3
#define UBO_MOTION 4
#define UBO_DRAW 5
#define UBO_SHADOW_VIEWS 6
#define UBO_WORLD 7
#define UBO_AVG 8
#define UBO_SPHERE 9

// Storage buffers. OpenGL promises eight, so passes that never run together share numbers.
#define SSBO_DRAWS 0
#define SSBO_MATERIALS 1
#define SSBO_PREVIOUS_DRAWS 2
#define SSBO_PREVIOUS_POSITIONS 3
#define SSBO_PATTERN 3
#define SSBO_PIXEL_LIST 4
#define SSBO_NEAR_COUNT 3
#define SSBO_TILE_FLAGS 3
#define SSBO_DEPTH_RANGE 3
#define SSBO_DISPATCH 5
#define SSBO_POINT_SOURCES 3
#define SSBO_POINT_SURFACES 4
#define SSBO_POINT_MATERIALS 0
#define SSBO_VPLS_OUT 2
#define SSBO_VIEWS_OUT 2
#define SSBO_ROW_SUMS 5
#define SSBO_TEXEL_SUMS 3
#define SSBO_VPLS 6
#define SSBO_IMPORTANCE 7
#define SSBO_IMPORTANCE_PIXELS 4
#define SSBO_VPL_SOURCES 6
#define SSBO_VPL_CHOICES 4
#define SSBO_SPHERE 1
#define SSBO_POINTS 7
#define SSBO_TRIANGLES 7
#define SSBO_PATCH_DROPPED 2
#define SSBO_PATCH_INDICES 3
#define SSBO_PATCH_PIECES 3
#define SSBO_PATCH_POSITIONS 4
#define SSBO_PATCH_COLORS 5
#define SSBO_PATCH_UVS 7
#define SSBO_PIECES_OUT 5
#define SSBO_PIECE_COMMANDS 6
#define SSBO_REUSE_COUNT 3
#define SSBO_CHECKED 6
#define SSBO_NOT_FINITE 7
// The approximate visibility grid is filled from all of these at once ...
#define SSBO_AVG_POSITIONS 2
#define SSBO_AVG_INDICES 3
#define SSBO_AVG_UV0 4
#define SSBO_AVG_UV1 5
#define SSBO_AVG_COLORS 6
#define SSBO_AVG_SUMS 7
// ... and traced with these.
#define SSBO_AVG_VOXELS 1
#define SSBO_AVG_RAYS 3
#define SSBO_AVG_NUMBERS 4
#define SSBO_DEFORM_JOBS 0
#define SSBO_POSITIONS 1
#define SSBO_NORMALS 2
#define SSBO_TANGENTS 3
#define SSBO_SKIN_INFLUENCES 4
#define SSBO_SKIN_MATRICES 5
#define SSBO_MORPH_DELTAS 6
#define SSBO_MORPH_WEIGHTS 7

// Texture units. Materials use the first four.
#define TEX_BASE_COLOR 0
#define TEX_METALLIC_ROUGHNESS 1
#define TEX_NORMAL 2
#define TEX_EMISSION 3
#define TEX_DEPTH 4
#define TEX_GBUFFER0 5
#define TEX_GBUFFER1 6
#define TEX_GBUFFER2 7
#define TEX_SHADOW 8
#define TEX_RSM 9
#define TEX_DIRECT 10
#define TEX_INDIRECT 11
#define TEX_LOWRES 12
#define TEX_GEOMETRIC_NORMAL 13
#define TEX_ENVIRONMENT 14
#define TEX_ENVIRONMENT_GLOSSY 15
#define TEX_ENVIRONMENT_BRDF 12
#define TEX_LOBES 14
#define TEX_DEPTH_SAMPLES 8
#define TEX_PREVIOUS_DEPTH 4
#define TEX_PEELED_DEPTH 9
#define TEX_HISTORY_NORMAL 8
#define TEX_MOTION 9
// Beyond those that passes leave bound for one another.
#define TEX_CHECKED 16

// Image units.
#define IMG_OUT 0
#define IMG_OUT1 1
#define IMG_IN 2
#define IMG_LOBES 1
#define IMG_ISM 3
#define IMG_RSM 4
#define IMG_SOURCES 1
#define IMG_HISTORY 3
#define IMG_HISTORY_LENGTH 4
#define IMG_AVG_CELLS 3
#define IMG_AVG_TILES 4
#define IMG_AVG_COUNTS 5

// Uniform locations of a library that several passes have.
#define UNIFORM_IMPORTANCE_FIRST 8

// Vertex attributes.
#define ATTRIB_POSITION 0
#define ATTRIB_NORMAL 1
#define ATTRIB_TANGENT 2
#define ATTRIB_UV0 3
#define ATTRIB_UV1 4
#define ATTRIB_COLOR 5
#define ATTRIB_DRAW 6

// Compute work-group sizes. 8x8 is one or two waves on every GPU and small enough that a tile of the
// screen is mostly one surface.
#define GROUP_2D 8
#define GROUP_1D 64
// Rows of texels of each thread that searches a texture for what is not finite.
#define CHECKED_ROWS 8
// Groups along one axis of a dispatch at most, where they may be more than the 65,535 that OpenGL promises.
#define MOST_GROUPS 32768
// One group sums a row of a map, or scans all row sums.
#define GROUP_ROW 64
#define GROUP_SCAN 256
// Virtual point lights that one dispatch of the gather evaluates at most, unrolled: they are then read from shared memory
// at constant places, which every driver turns into scalar loads.
#define VPL_CHUNK 16
// Samples of each map that the near field takes at a pixel: 8 or 16.
#define NEAR_SAMPLES 8
#define NEAR_SAMPLES_GLOSSY 16
// Roughness of the prefiltered world image's first level; its last is 1; the
// logarithm grows evenly.
#define ENVIRONMENT_FIRST_ROUGHNESS 0.2
#define ENVIRONMENT_LEVELS 5
// passes/vpl_choose.comp
#define SAMPLER_UNIFORM 0
#define SAMPLER_INVERSE2 1
#define SAMPLER_INVERSE3 2
#define SAMPLER_METROPOLIS 3
#define SAMPLER_SINGLE 4
#define SAMPLER_UNREDUCED 5
#define SAMPLER_RESAMPLED 6
// Depth samples a pixel for antialiasing. OpenGL promises four.
#define AA_SAMPLES 4
// One group splats the points of one imperfect shadow map.
#define GROUP_SPLAT 128
// Columns of voxels a side of a tile: one group takes a large triangle through one tile. Triangles over at most
// AVG_SMALL columns are taken through all by one thread.
// Words of a surface's sums (lib/avg_triangle.glsl).
#define AVG_SUM_WORDS 28
#define AVG_SUM_STEPS 1099511627776.0
#define AVG_TILE 8
#define AVG_SMALL 16
// Tiles of one batch of draws that are listed at most, AVG_TILE_ROW a row of the list; a triangle that finds it full is
// taken through by its thread. Groups that take tiles off the list.
#define AVG_TILE_ROW 1024
#define AVG_MOST_TILES 1048576
#define AVG_TILE_GROUPS 512
// Tiles of such a map, and the triangles that are drawn into it at most.
#define GROUP_MAP_TILE 16
#define MOST_TRIANGLES 64
// Points of one patch at most, where splats are made by tessellation: lines of points, and points a line. OpenGL promises
// levels of 64; a line of so many segments has a point more.
#define PATCH_LINES 64
#define PATCH_LINE_POINTS 65
#define PATCH_POINTS (PATCH_LINES * PATCH_LINE_POINTS)
// PatchDropped: of a draw, all of whose triangles stay, or none.
#define PATCH_KEEPS_ALL 0xffffffffu
#define PATCH_KEEPS_NONE 0xfffffffeu

#endif
