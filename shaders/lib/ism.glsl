// SPDX-License-Identifier: Apache-2.0
//
// Imperfect shadow maps (Ritschel et al. 2008): one small parabolic map for each virtual point light, all in one
// atlas. A texel (ISM_EMPTY where nothing was hit):
//   high 16 bits  distance of the nearest surface at the texel's centre, half
//   low 16 bits   how 1/distance changes from the centre by a step of one texel along s and t, over 1/distance, in
//                 64ths, 8 bits each
// A plane's 1/distance is linear in the map to first order, so a receiver is compared with the surface where its own
// ray meets it: a surface does not hide itself, however steep it stands, and nothing leaks at its foot.
//
// DISTANT: maps of lights at infinity, orthographic along the light's way: a cube around what may hide the light
// (renderer/world_lights.h). A texel:
//   high 16 bits  depth of the nearest surface at the texel's centre along that way, over the cube
//   low 16 bits   how it changes by a step of one texel along s and t, over the texel's width, in 16ths, 8 bits each
// A plane's depth is linear in the map, so the comparison is exact. A receiver may lie beyond the cube: behind it, what
// stands in the cube hides it all the same; beside it, nothing does.
#ifndef LIB_ISM
#define LIB_ISM

#include "lib/paraboloid.glsl"
#include "lib/vpl.glsl"

#ifdef DISTANT
const uint ISM_EMPTY = 0xffff0000u;
#else
const uint ISM_EMPTY = 0x7bff0000u;  // the largest finite half
#endif

// A plane nearer to a light than this, in render units (the scene's diagonal is 1), is the light's own surface.
const float LEAST_PLANE_DISTANCE = 1e-4;

// What rounding may take from a texel's distance: half a step of a half float, and half a step of each slope at a
// texel's corner. Each distance is given this much, so that a surface does not hide itself by rounding alone.
const float ISM_ROUNDING = 1.0 / 2048.0 + 0.5 / 64.0;

// Slope of a plane's 1/distance at `at` (-1 to 1) of a map, for pack_ism(): the derivative of normal . direction over
// its value there, `along`. A difference over a texel would add the map's own curvature, which counts in small maps.
vec2 plane_slope(vec3 normal, float along, vec2 at, float texel_size) {
    return ((normal.xy - at * normal.z) / along - at) * (2.0 * texel_size / (1.0 + dot(at, at)));
}

uint pack_ism(float distance, vec2 slope) {
    distance *= 1.0 + ISM_ROUNDING;
    ivec2 steps = ivec2(clamp(round(slope * 64.0), -127.0, 127.0));
    return packHalf2x16(vec2(0.0, distance)) | uint(steps.x & 0xff) | uint(steps.y & 0xff) << 8;
}

// A splat of one depth, which has no slope to be rounded.
uint pack_ism_flat(float distance) {
    return packHalf2x16(vec2(0.0, distance * (1.0 + 1.0 / 2048.0)));
}

// Whether a receiver at a distance is no farther than what the texel holds; from_center: from the texel's centre to
// the receiver's place in the map, in texels.
bool ism_lit(uint bits, float distance, vec2 from_center) {
    float nearest = unpackHalf2x16(bits).y;
    vec2 slope = vec2(int(bits << 24) >> 24, int(bits << 16) >> 24) / 64.0;
    return distance * (1.0 + dot(slope, from_center)) <= nearest;
}

// Half the width and depth of a distant light's map, render units.
float distant_reach(GpuVpl vpl) {
    return vpl.tangent.w;
}

// As pack_ism() and ism_lit(), of distant lights. depth: along the light's way from the middle of its map, and slope, its
// derivatives along s and t, in units of the map's reach; size: texels a side of the map.
uint pack_distant(float depth, vec2 slope, float size) {
    float texel_size = 2.0 / size;
    ivec2 steps = ivec2(clamp(round(slope * 16.0), -127.0, 127.0));
    // What rounding may take: half a step of each slope at a texel's corner. A plane steeper than what 8 bits hold must
    // not hide itself either.
    vec2 missing = max(abs(slope) - 127.0 / 16.0, vec2(0.0));
    depth += texel_size * (1.0 / 32.0 + 0.5 * (missing.x + missing.y));
    // What lies before the map hides all that is in it.
    steps = depth < -1.0 ? ivec2(0) : steps;
    uint bits = uint(clamp(ceil((0.5 * depth + 0.5) * 65535.0), 0.0, 65534.0)) << 16 | uint(steps.x & 0xff) |
                uint(steps.y & 0xff) << 8;
    return depth > 1.0 ? ISM_EMPTY : bits;
}

bool distant_lit(uint bits, float depth, vec2 from_center, float size) {
    vec2 slope = vec2(int(bits << 24) >> 24, int(bits << 16) >> 24) / 16.0;
    float nearest = float(bits >> 16) / 65535.0 * 2.0 - 1.0;
    return bits == ISM_EMPTY || depth <= nearest + dot(slope, from_center) * (2.0 / size);
}

ivec2 ism_origin(int map) {
    return ivec2(map % ism.atlas.y, map / ism.atlas.y) * ism.atlas.x;
}

// The part of the parabolic disk that a light's map shows: its middle, and half of its side. WINDOW: maps of places on a light
// that shines itself show no more than what lies between it and what the camera sees (renderer/imperfect_setup.h).
vec3 map_window(GpuVpl vpl) {
#ifdef WINDOW
    return vpl.incident.xyz;
#else
    return vec3(0.0, 0.0, 1.0);
#endif
}

// Coordinates in the frame of a light's map: along its s and t axes and its normal.
vec3 vpl_from_render(GpuVpl vpl, vec3 offset) {
    return vec3(dot(offset, vpl.tangent.xyz), dot(offset, vpl.bitangent.xyz), dot(offset, vpl.normal.xyz));
}

#endif
