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

// Maps of a soft shadow that one dispatch evaluates, unrolled: they are read from a uniform block at constant places,
// which every driver turns into scalar loads.
#define SHADOW_VIEW_CHUNK 8

// Blended materials (scene/transparency.h): below the first alpha there is nothing, from the second on it is opaque.
#define ALPHA_NOTHING (1.0 / 512.0)
#define ALPHA_SOLID (511.0 / 512.0)
// What a pass draws of a blended material, BLEND_RULE.
#define BLEND_HALF 0    // a cut-out at one half
#define BLEND_SOLID 1   // where it is opaque
#define BLEND_HASHED 2  // a part alpha of the texels (lib/alpha_threshold.glsl)
#define BLEND_PEEL 3    // where it is neither nothing nor opaque, behind what was peeled off and before what is opaque

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
    vec4 composite;         // film exposure, direct on, smoothing of shadows in pixels, scale of bounced light in half floats
};

// The world's image (lib/environment.glsl).
struct WorldUniforms {
    vec4 environment_from_render[3];  // rows of the rotation; w of the first: strength
    vec4 detail;            // radians that a texel of the image spans, levels of the image less one, the same of the
                            // prefiltered image, -
};

// The world as cells that lights are drawn from (lib/sphere.glsl).
struct SphereUniforms {
    vec4 render_from_environment[3];  // rows of the rotation
    ivec4 grid;             // cells across and down, -, -
    vec4 light;             // strength, weight of a luminance where visibility is averaged for reflections, -, -
};

// One rasterised view: the camera or a face of a light.
struct ViewUniforms {
    mat4 clip_from_render;
    vec4 eye;               // xyz render space, where maps of planes tell distances from;
                            // w: of several views of one light its place + 4096 * places, of others any number below
};

// One light; each is a pass of its own, with its map and profile compiled in.
struct GpuLight {
    vec4 position;          // xyz render space (sun: centre of the map's near plane)
    vec4 axis;              // xyz unit, where the light looks; w: tan of the map's half angle (perspective)
    vec4 tangent;           // xyz unit, map +s; w: half extent of an orthographic map
    vec4 bitangent;         // xyz unit, map +t; w: half extent of an orthographic map
    vec4 intensity;         // rgb: W/sr on the axis (sun: W/m^2), render-space units; w: squared radius
    vec4 cone;              // spot: 1 - cos of the half angle, 1/(blend width in cos) or 0 for a hard edge,
                            // khronos: scale and offset of its angular attenuation;
                            // z: 1 over how many places its bounced light starts from; w, sun: tan of half its angle
    vec4 area;              // half sizes in render space; tan and normalisation of the spread
    vec4 map;               // RSM size, shadow map size, near plane (orthographic: depth range), area ellipse 0/1
};

// A map of a light's soft shadow: seen from one place on the light (sun: along one direction of its disk). A point of the
// map's ray at (s, t) is origin + depth * (s right + t up + forward), or, of a sun, origin + s right + t up + depth forward.
struct GpuShadowView {
    vec4 origin;            // xyz render space; w: near plane (orthographic: depth range)
    vec4 to_s;              // xyz: rows of the inverse of (right, up, forward); w: offset of the receiver in the
                            // picture, pixels
    vec4 to_t;              // w: the same, along y
    vec4 to_depth;
    vec4 right;
    vec4 up;
    vec4 forward;           // w: map size
};

struct ShadowViews {
    GpuShadowView view[SHADOW_VIEW_CHUNK];
};

struct GpuMaterial {
    vec4 base_color;
    vec4 emission;          // rgb radiance, a: alpha cutoff
    vec4 surface;           // metallic, roughness, specular, normal scale
    ivec4 flags;            // diffuse model, unlit, 1 where the normal scale is Cycles' strength, -
    vec4 uv[8];             // per texture two rows of uv_transform (xyz); the first row's w is the uv set
};

struct GpuDraw {
    vec4 render_from_model[3];  // rows
    vec4 normal_from_model[3];  // rows of the cofactor matrix (xyz)
    ivec4 ids;                  // material, 1 where the transform mirrors, a number that stays the draw's own, how far
                                // its simplified surface moved (render units, float bits)
};

// The camera of the frame before, for the layer that shows motion.
struct MotionUniforms {
    mat4 clip_from_render;
    mat4 render_from_clip;
    vec4 eye;               // xyz render space; w: metres a render unit
    vec4 forward;           // xyz unit; w: width of a pixel at distance 1 (orthographic: everywhere)
    vec4 picture;           // width, height (pixels), 1 perspective or 0 orthographic, -
};

// Where a draw's model stood in the frame before.
struct GpuPreviousDraw {
    vec4 render_from_model[3];  // rows
    ivec4 ids;                  // 1 where it was drawn then, -, -, -
};

// A virtual point light: one sample of what the lights' reflective shadow maps reflect.
struct GpuVpl {
    vec4 position;          // xyz render space; w: surface area it stands for
    vec4 normal;            // xyz unit; w: roughness of the diffuse lobe, negative where it is Disney's
    vec4 tangent;           // xyz unit, s axis of its shadow map; w: 1 / squared near radius
    vec4 bitangent;         // xyz unit, t axis of its shadow map; w: place of its map in the atlas, 16 bits each
    vec4 intensity;         // rgb: diffusely reflected flux / pi, W/sr along the normal; w: (1 - cos)^5 at incidence
    vec4 incident;          // xyz unit, the direction light arrives along; w: cosine of incidence
    vec4 glossy;            // rgb: arriving flux times the glossy lobe's reflectance at normal incidence;
                            // w: alpha^2 of the lobe
    vec4 arriving;          // rgb: arriving flux, what that reflectance rises to at grazing incidence;
                            // w: Smith's term of the incident direction
};

// A pixel that virtual point lights are judged by (lib/importance_pixels.glsl).
struct GpuImportancePixel {
    vec4 position;          // xyz render space; w: share of the picture, 0 where nothing is seen
    vec4 normal;            // xyz unit; w: n.v
    vec4 view;              // xyz unit, towards the viewer; w: (1 - n.v)^5
    vec4 albedo;            // diffuse, over pi; w: roughness of the diffuse lobe, negative where it is Lambert's
    vec4 f0;                // of the glossy lobe; w: f90
    vec4 lobe;              // alpha^2, Smith's term of the view; -; -
};

// The imperfect shadow maps of a frame: square maps of one size in one atlas, row by row.
struct IsmUniforms {
    ivec4 atlas;            // map size (texels), maps a row, maps, points a map
    ivec4 points;           // points in the sequence, place of its first one, reflective maps: size of
                            // the lights' shadow maps; how many maps' points each takes its own from later on
    vec4 splat;             // squared radius of a splat over that of its point; set-back of a disk in its radii
                            // (reflective maps: area of a point where they are dense, or 0); constant bias; bias by
                            // slope, in texel widths
    ivec4 gather;           // interleave n, VPLs a subset, columns of a subset's cells, -
};

// The approximate visibility grid (lib/avg.glsl).
struct AvgUniforms {
    vec4 origin;            // xyz render space, corner of the first voxel; w: side of a voxel
    ivec4 size;             // voxels along x, y, z; surfaces (GpuAvgVoxel) there is room for
    ivec4 sides;            // 6, 4: how often some loops run, so that they stay loops; -; -
};

// The surfaces of one voxel whose normals point along the same axis most, as they are traced.
struct GpuAvgVoxel {
    vec4 tensor_diagonal;   // sum of area * normal normal^T: xx, yy, zz; w: all their area, faces of a voxel
    vec4 tensor_rest;       // xy, xz, yz; w: opaque part of the area
    vec4 normal;            // xyz unit, the tensor's main direction, on no particular side; -
    vec4 color;             // base colour, mean by area; -
    vec4 surface;           // roughness, metallic, specular, 1 where the diffuse lobe is Disney's
    ivec4 slab;             // least and largest place along `normal` from the voxel's middle, voxels * AVG_SLAB_STEPS,
                            // of the surfaces that face up their axis, and of those that face down
};
#define AVG_SLAB_STEPS 1048576.0

// A ray from a light into the grid.
struct GpuAvgRay {
    vec4 origin;            // xyz render space; w: 1 where it leaves a surface across `leaving`
    vec4 direction;         // xyz unit; w: squared radius of the light, which weakens it near by
    vec4 flux;              // rgb W, render-space units; -
    vec4 leaving;           // xyz unit; -
};

// A point of the scene's surfaces as it was sampled; see scene/points.
struct GpuPointSource {
    uvec4 place;            // three vertices in the position stream, surface
    vec4 weights;           // barycentric of the second and third vertex, share of the triangle's area, negated
                            // on a large plane; w: its place in the sequence, uint bits
};

// A sample of a surface that emits; see scene/points/emitters.h.
struct GpuEmitterSource {
    uvec4 place;            // three vertices in the position stream, surface
    vec4 weights;           // barycentric of the second and third vertex; share of the triangle's area, negated for
                            // the side where the triangle turns clockwise; -
    vec4 radiance;          // rgb W/(m^2 sr); -
};

// Where a surface stands at this pose.
struct GpuPointSurface {
    vec4 render_from_model[3];  // rows
    ivec4 ids;                  // material, 1 where it is drawn, -, -
};

// A part of a triangle that has more points than a patch can give; see shaders/lib/patch.glsl.
struct GpuPatchPiece {
    uvec4 place;            // three vertices, draw
    uvec4 number;           // triangle of its mesh's primitive, piece from 1, -, -
};

// As glDrawArraysIndirect() reads it.
struct GpuPieceCommand {
    uvec4 draw;             // pieces, instances, first piece, first instance
};

struct DeformJob {
    ivec4 vertices;         // source first, destination first, count, -
    ivec4 skin;             // first influence or -1, first matrix, -, -
    ivec4 morph;            // first delta, targets, first weight, vec4s a vertex and target (1 position, 2 +normal)
};

#endif
