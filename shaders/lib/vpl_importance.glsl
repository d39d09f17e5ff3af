// SPDX-License-Identifier: Apache-2.0
//
// A light's reflective shadow map as a source of virtual point lights. lib/irsm.glsl has the same functions for
// imperfect ones.
#ifndef LIB_VPL_IMPORTANCE
#define LIB_VPL_IMPORTANCE

#include "lib/rsm.glsl"

// Texels a row, and rows a layer.
int source_size() {
    return int(light.map.x);
}

int source_rows() {
    return int(light.map.x);
}

vec2 texel_center(ivec2 texel) {
    return (vec2(texel) + 0.5) * (2.0 / light.map.x) - 1.0;
}

// Solid angle of a texel from the light, or its area across a sun's rays.
float texel_measure(ivec2 texel) {
    float side = 2.0 / light.map.x;
    return map_measure(texel_center(texel), side * side);
}

float texel_measure(ivec2 texel, PixelLight p) {
    return texel_measure(texel);
}

bool load_pixel_light(ivec2 texel, int layer, out PixelLight p) {
    return decode_pixel_light(load_rsm(texel, layer), texel, layer, p);
}

// What a texel counts for when virtual point lights are drawn: the flux it reflects, or what IMPORTANCE_MAP has
// (passes/vpl_importance.comp).
#ifdef IMPORTANCE_MAP
#include "lib/importance_map.glsl"
#else
float texel_importance(ivec2 texel, int layer) {
    uvec4 bits = load_rsm(texel, layer);
    vec3 color = vec3(unpackHalf2x16(bits.z), unpackHalf2x16(bits.w).x);
    float metallic = float(bits.w >> 23 & 15u) / 15.0;
    return bits.x == 0u ? 0.0 : importance_density(color, metallic, light.intensity.rgb) * texel_measure(texel);
}
#endif

#endif
