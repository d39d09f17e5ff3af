// SPDX-License-Identifier: Apache-2.0
//
// Triangles as patches that tessellation makes points of (Barak, Bittner and Havran 2013, "Temporally Coherent Adaptive
// Sampling for Imperfect Shadow Maps", section 5.2). A patch is one vertex, which stands for a triangle: the vertex
// stage looks its corners up where the deform pass left them.
#ifndef LIB_PATCH
#define LIB_PATCH

#include "lib/patch_points.glsl"
#include "shared/bindings.h"
#include "shared/types.h"

layout(location = 1) uniform vec4 spread;  // points of all maps on a squared render unit; maps; squared radius of the
                                           // disk that a map's point stands for, squared render units; -

#ifdef LOAD_PATCHES
layout(std430, binding = SSBO_DRAWS) readonly buffer DrawBlock { GpuDraw draws[]; };
layout(std430, binding = SSBO_PATCH_POSITIONS) readonly buffer PositionBlock { float positions[]; };
#ifndef PIECES
layout(std430, binding = SSBO_PATCH_INDICES) readonly buffer IndexBlock { uint indices[]; };
#ifdef DROPS
// A word a draw: PATCH_KEEPS_ALL, PATCH_KEEPS_NONE or the place of its first word of bits, one a triangle.
layout(std430, binding = SSBO_PATCH_DROPPED) readonly buffer DroppedBlock { uint dropped[]; };
#endif
#endif
#endif

#ifdef LOAD_PATCHES
struct PatchTriangle {
    uvec3 vertices;  // in the stream of positions
    uint draw;
    uint draw_number;  // GpuDraw::ids.z
    uint number;       // of its mesh's primitive
    vec3 a, ab, ac;  // a corner, and the ways to the others; render space
};

#ifndef PIECES
bool is_dropped(uint draw, uint triangle) {
#ifdef DROPS
    uint first = dropped[draw];
    return first == PATCH_KEEPS_NONE ||
           first != PATCH_KEEPS_ALL && (dropped[first + (triangle >> 5u)] >> (triangle & 31u) & 1u) == 1u;
#else
    return false;
#endif
}
#endif

vec3 patch_corner(GpuDraw draw, uint vertex) {
    vec4 p = vec4(positions[3u * vertex], positions[3u * vertex + 1u], positions[3u * vertex + 2u], 1.0);
    return vec3(dot(draw.render_from_model[0], p), dot(draw.render_from_model[1], p), dot(draw.render_from_model[2], p));
}

PatchTriangle make_patch(uvec3 vertices, uint draw_index, uint number) {
    GpuDraw draw = draws[draw_index];
    PatchTriangle t;
    t.vertices = vertices;
    t.draw = draw_index;
    t.draw_number = uint(draw.ids.z);
    t.number = number;
    t.a = patch_corner(draw, vertices.x);
    t.ab = patch_corner(draw, vertices.y) - t.a;
    t.ac = patch_corner(draw, vertices.z) - t.a;
    return t;
}

#ifndef PIECES
// A triangle of a primitive whose indices begin at `first`.
PatchTriangle load_patch(uint first, uint base_vertex, uint draw, uint number) {
    uint i = first + 3u * number;
    return make_patch(base_vertex + uvec3(indices[i], indices[i + 1u], indices[i + 2u]), draw, number);
}
#endif
#endif

#endif
