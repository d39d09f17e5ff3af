// SPDX-License-Identifier: Apache-2.0
//
// The world as a map that virtual point lights are drawn from: cells of the sphere, laid out as an equirectangular image.
// lib/vpl_importance.glsl has the same functions for a light's reflective shadow map.
#ifndef LIB_SPHERE
#define LIB_SPHERE

#include "lib/environment_directions.glsl"
#include "shared/bindings.h"
#include "shared/types.h"

layout(std140, binding = UBO_SPHERE) uniform SphereBlock {
    SphereUniforms sphere;
};
layout(std430, binding = SSBO_SPHERE) readonly buffer SphereCellBlock {
    vec4 sphere_cells[];  // rgb: irradiance on a facing plane at a strength of 1; w: solid angle
};

int source_size() {
    return sphere.grid.x;
}

int source_rows() {
    return sphere.grid.y;
}

vec4 sphere_cell(ivec2 texel) {
    vec4 cell = sphere_cells[texel.y * sphere.grid.x + texel.x];
    return vec4(cell.rgb * sphere.light.x, cell.w);
}

// The unit vector that light from a place of a cell (0 to 1 both ways) travels along, render space.
vec3 sphere_way(ivec2 texel, vec2 inside) {
    vec3 d = environment_direction((vec2(texel) + inside) / vec2(sphere.grid.xy));
    return -vec3(dot(sphere.render_from_environment[0].xyz, d), dot(sphere.render_from_environment[1].xyz, d),
                 dot(sphere.render_from_environment[2].xyz, d));
}

float sphere_luminance(vec3 irradiance) {
    return dot(irradiance, vec3(0.2126, 0.7152, 0.0722));
}

#ifdef IMPORTANCE_MAP
#include "lib/importance_map.glsl"
#else
float texel_importance(ivec2 texel, int layer) {
    return sphere_luminance(sphere_cell(texel).rgb);
}
#endif

#endif
