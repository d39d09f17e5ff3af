// SPDX-License-Identifier: Apache-2.0
//
// Structs that C++ writes and GLSL reads. Compiled by both; only vec4, ivec4, uvec4 and mat4 members, so
// that std140, std430 and C++ agree on the layout. Sizes are asserted in previewer/gpu/shared_types.h.
//
// "Render space" is world space moved to the scene's centre and scaled by its extent (gpu/render_space.h).
#ifndef BOUNCE_SHARED_TYPES_H
#define BOUNCE_SHARED_TYPES_H

// Where a light's shadow map and RSM come from.
#define MAP_PERSPECTIVE 0  // spot up to 120 degrees: one square around the cone
#define MAP_ORTHOGRAPHIC 1 // sun: one square around the scene
#define MAP_CUBE 2         // point, wide spot, area: six squares

// How emission depends on direction.
#define PROFILE_UNIFORM 0
#define PROFILE_SPOT_CYCLES_3 1
#define PROFILE_SPOT_CYCLES_4 2
#define PROFILE_SPOT_KHRONOS 3
#define PROFILE_AREA 4

#define DIFFUSE_LAMBERT 0
#define DIFFUSE_DISNEY 1

struct FrameUniforms {
    mat4 render_from_clip;
    vec4 camera_position;   // xyz; w: 1 perspective, 0 orthographic
    vec4 camera_forward;    // xyz unit
    vec4 world_radiance;    // rgb
    ivec4 size;             // width, height, low-resolution step (pixels), RSM samples
    vec4 interpolation;     // cos of the largest normal difference, largest plane distance in footprints,
                            // radius of a pixel's footprint at distance 1 (or its half size, orthographic), -
    vec4 composite;         // film exposure, direct on, indirect on, -
};

// One rasterised view: the camera or a face of a light.
struct ViewUniforms {
    mat4 clip_from_render;
    ivec4 face;             // cube face or 0, -, -, -
};

// One light; each is a pass of its own, with its map and profile compiled in.
struct GpuLight {
    vec4 position;          // xyz render space (sun: centre of the map's near plane)
    vec4 axis;              // xyz unit, where the light looks; w: tan of the map's half angle (perspective)
    vec4 tangent;           // xyz unit, map +s; w: half extent of an orthographic map
    vec4 bitangent;         // xyz unit, map +t; w: half extent of an orthographic map
    vec4 intensity;         // rgb: W/sr on the axis (sun: W/m^2), render-space units; w: squared radius
    vec4 cone;              // spot: cos of the half angle, 1/(blend width in cos) or 0 for a hard edge,
                            // khronos: scale and offset of its angular attenuation
    vec4 area;              // half sizes in render space; tan and normalisation of the spread
    vec4 map;               // RSM size, shadow map size, near plane (orthographic: depth range), area ellipse 0/1
};

struct GpuMaterial {
    vec4 base_color;
    vec4 emission;          // rgb radiance, a: alpha cutoff
    vec4 surface;           // metallic, roughness, specular, normal scale
    ivec4 flags;            // diffuse model, unlit, -, -
    vec4 uv[8];             // per texture two rows of uv_transform (xyz); the first row's w is the uv set
};

struct GpuDraw {
    vec4 render_from_model[3];  // rows
    vec4 normal_from_model[3];  // rows of the cofactor matrix (xyz)
    ivec4 ids;                  // material, 1 where the transform mirrors, -, -
};

struct DeformJob {
    ivec4 vertices;         // source first, destination first, count, -
    ivec4 skin;             // first influence or -1, first matrix, -, -
    ivec4 morph;            // first delta, targets, first weight, vec4s a vertex and target (1 position, 2 +normal)
};

#endif
