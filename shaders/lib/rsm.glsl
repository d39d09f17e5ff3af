// SPDX-License-Identifier: Apache-2.0
//
// The reflective shadow map (Dachsbacher and Stamminger 2005). The paper stores depth, position, normal
// and flux in three targets; here a texel is one uvec4, so that a gather sample is one fetch:
//   x  depth along the map's axis, float bits; 0 where nothing was hit
//   y  octahedral normal, 2 x 16 bit snorm
//   z  base colour * profile, red and green, halves
//   w  the same, blue, half; roughness (7 bits), metallic (4), specular (4, in eighths), Disney's diffuse lobe (1)
// Position follows from depth and the texel's place. The stored colour is relative to the light's
// intensity on its axis, so that no power over- or underflows a half; flux is that times intensity times
// the solid angle (sun: the area) that the texel or sample stands for.
#ifndef LIB_RSM
#define LIB_RSM

#include "lib/brdf.glsl"
#include "lib/light.glsl"
#include "lib/pixel_light.glsl"

uvec4 pack_rsm(float depth, Surface s, float profile) {
    vec3 color = s.base_color * profile;
    uint bits = uint(clamp(s.roughness, 0.0, 1.0) * 127.0 + 0.5) | uint(clamp(s.metallic, 0.0, 1.0) * 15.0 + 0.5) << 7 |
                uint(clamp(s.specular * 8.0, 0.0, 15.0) + 0.5) << 11 | (s.disney ? 1u << 15 : 0u);
    return uvec4(floatBitsToUint(depth), packSnorm2x16(octahedral_encode(s.normal)), packHalf2x16(color.rg),
                 (packHalf2x16(vec2(color.b, 0.0)) & 0xffffu) | bits << 16);
}

// What an area of a map, in its -1 to 1 coordinates, measures at st: solid angle from the light, or area across a
// sun's rays.
float map_measure(vec2 st, float area) {
#if MAP_KIND == MAP_PERSPECTIVE
    float t2 = light.axis.w * light.axis.w;
    float c2 = 1.0 / (1.0 + t2 * dot(st, st));
    return area * t2 * c2 * sqrt(c2);
#elif MAP_KIND == MAP_CUBE
    float c2 = 1.0 / (1.0 + dot(st, st));
    return area * c2 * sqrt(c2);
#else
    return area * light.tangent.w * light.bitangent.w;
#endif
}

// The pixel light of a texel. False where the map is empty; p is then of no use, but finite.
bool decode_pixel_light(uvec4 bits, ivec2 texel, int layer, out PixelLight p) {
    float depth = uintBitsToFloat(bits.x);
    // The texel's centre, where its depth was taken.
    vec2 center = (vec2(texel) + 0.5) / light.map.x * 2.0 - 1.0;
#if MAP_KIND == MAP_ORTHOGRAPHIC
    vec3 local = vec3(center * vec2(light.tangent.w, light.bitangent.w), depth);
    p.from_light = light.axis.xyz;
    p.squared_distance = 1.0;
#elif MAP_KIND == MAP_PERSPECTIVE
    vec3 local = vec3(center * light.axis.w, 1.0) * depth;
#else
    vec3 local = cube_direction(layer, center) * depth;
#endif
    vec3 offset = render_from_light_vector(local);
    p.position = light.position.xyz + offset;
#if MAP_KIND != MAP_ORTHOGRAPHIC
    p.squared_distance = max(dot(offset, offset), 1e-20);
    p.from_light = offset * inversesqrt(p.squared_distance);
#endif
    p.normal = octahedral_decode(unpackSnorm2x16(bits.y));
    p.color = vec3(unpackHalf2x16(bits.z), unpackHalf2x16(bits.w).x);
    p.roughness = float(bits.w >> 16 & 127u) / 127.0;
    p.metallic = float(bits.w >> 23 & 15u) / 15.0;
    p.specular = float(bits.w >> 27 & 15u) / 8.0;
    p.disney = (bits.w >> 31) == 1u;
    p.arriving = light.intensity.rgb;
    p.profile = 1.0;
    p.area = 0.0;
#if defined(GLOSSY) && MAP_KIND != MAP_ORTHOGRAPHIC
    p.profile = light_profile(light_vector_from_render(p.from_light)) * p.squared_distance /
                (p.squared_distance + light.intensity.w);
#endif
    return depth > 0.0;
}

#ifdef READ_RSM
layout(binding = TEX_RSM) uniform usampler2DArray rsm_texture;

uvec4 load_rsm(ivec2 texel, int layer) {
    return texelFetch(rsm_texture, ivec3(texel, layer), 0);
}

// The pixel light at map coordinates st (-1 to 1) of a layer. False where the map is empty.
bool read_pixel_light(vec2 st, int layer, out PixelLight p) {
    float size = light.map.x;
    ivec2 texel = clamp(ivec2((st * 0.5 + 0.5) * size), ivec2(0), ivec2(int(size) - 1));
    return decode_pixel_light(load_rsm(texel, layer), texel, layer, p);
}
#endif
#ifdef READ_RSM_IMAGE
// The same map as an image: on llvmpipe a plain load costs a third of a texel fetch.
layout(binding = IMG_RSM, rgba32ui) readonly uniform uimage2DArray rsm_image;

uvec4 load_rsm(ivec2 texel, int layer) {
    return imageLoad(rsm_image, ivec3(texel, layer));
}
#endif

#endif
