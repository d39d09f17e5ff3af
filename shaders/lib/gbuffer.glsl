// SPDX-License-Identifier: Apache-2.0
//
// The G-buffer's layout.
//   0  RGBA16F  base colour, roughness
//   1  RGBA16   octahedral normal, metallic, specular and diffuse model
//   2  RG16     octahedral normal of the triangle itself, for what depends on true geometry; of a layer of blended
//               surfaces RGBA16, z: alpha, 0 where there is none
//   3  RGBA32F  emission (only where the scene has any)
//   depth       32-bit float, 1 near, 0 far; 0 where nothing was drawn
#ifndef LIB_GBUFFER
#define LIB_GBUFFER

#include "lib/brdf.glsl"
#include "shared/types.h"

// Principled's Specular may exceed 1; what is stored covers 0 to 2. The lowest bit of the 16 is the
// diffuse model.
float pack_specular(float specular, bool disney) {
    float steps = round(clamp(specular * 0.5, 0.0, 1.0) * 32767.0);
    return (steps * 2.0 + (disney ? 1.0 : 0.0)) / 65535.0;
}

void unpack_specular(float stored, out float specular, out bool disney) {
    uint bits = uint(round(stored * 65535.0));
    disney = (bits & 1u) == 1u;
    specular = float(bits >> 1) / 32767.0 * 2.0;
}

vec4 pack_gbuffer1(Surface s) {
    return vec4(octahedral_encode(s.normal) * 0.5 + 0.5, s.metallic, pack_specular(s.specular, s.disney));
}

vec3 unpack_normal(vec4 gbuffer1) {
    return octahedral_decode(gbuffer1.xy * 2.0 - 1.0);
}

#ifdef READ_GBUFFER
#include "lib/frame.glsl"
layout(binding = TEX_DEPTH) uniform sampler2D depth_texture;
layout(binding = TEX_GBUFFER0) uniform sampler2D gbuffer0_texture;
layout(binding = TEX_GBUFFER1) uniform sampler2D gbuffer1_texture;

// The render-space point a pixel shows. depth must not be 0.
vec3 pixel_position(ivec2 pixel, float depth) {
    vec2 ndc = (vec2(pixel) + 0.5) / vec2(frame.size.xy) * 2.0 - 1.0;
    vec4 p = frame.render_from_clip * vec4(ndc, depth, 1.0);
    return p.xyz / p.w;
}

// Returns the depth, 0 where the pixel shows no surface; s is then of no use, but finite. Without a branch, so
// that what follows is not in one.
float read_surface_unbranched(ivec2 pixel, out Surface s) {
    float depth = texelFetch(depth_texture, pixel, 0).r;
    vec4 g0 = texelFetch(gbuffer0_texture, pixel, 0);
    vec4 g1 = texelFetch(gbuffer1_texture, pixel, 0);
    s.position = pixel_position(pixel, depth > 0.0 ? depth : 0.5);
    s.normal = unpack_normal(g1);
    s.base_color = g0.rgb;
    s.roughness = g0.a;
    s.metallic = g1.z;
    unpack_specular(g1.w, s.specular, s.disney);
    return depth;
}

// False where the pixel shows no surface.
bool read_surface(ivec2 pixel, out Surface s) {
    return read_surface_unbranched(pixel, s) > 0.0;
}
#endif

#endif
