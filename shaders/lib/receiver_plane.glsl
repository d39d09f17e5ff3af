// SPDX-License-Identifier: Apache-2.0
//
// The plane of the triangle that a pixel shows; with READ_GBUFFER.
#ifndef LIB_RECEIVER_PLANE
#define LIB_RECEIVER_PLANE

#include "lib/gbuffer.glsl"

layout(binding = TEX_GEOMETRIC_NORMAL) uniform sampler2D geometric_normal_texture;

// A shadow map holds triangles, not what normal maps and smooth shading make of them.
vec3 geometric_normal(ivec2 pixel) {
    return octahedral_decode(texelFetch(geometric_normal_texture, pixel, 0).xy * 2.0 - 1.0);
}

// The step on a surface's plane from a pixel to another, which shows a point at the same depth.
vec3 step_on_plane(vec3 position, vec3 normal, vec3 v, ivec2 other, float depth) {
    vec3 d = pixel_position(other, depth) - position;
    // A plane seen from its edge goes on for ever; its filter does not.
    float slant = dot(normal, v);
    slant = slant < 0.0 ? min(slant, -0.05) : max(slant, 0.05);
    return d - v * (dot(normal, d) / slant);
}

#endif
