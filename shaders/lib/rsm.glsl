// SPDX-License-Identifier: Apache-2.0
//
// The reflective shadow map (Dachsbacher and Stamminger 2005). The paper stores depth, position, normal
// and flux in three targets; here a texel is one uvec4, so that a gather sample is one fetch:
//   x  depth along the map's axis, float bits; 0 where nothing was hit
//   y  octahedral normal, 2 x 16 bit snorm
//   z  reflectance * profile, red and green, halves
//   w  the same, blue, half; roughness, half, negative where the diffuse lobe is Disney's
// Position follows from depth and the texel's place. The stored colour is relative to the light's
// intensity on its axis, so that no power over- or underflows a half; flux is that times intensity times
// the solid angle (sun: the area) that the texel or sample stands for.
#ifndef LIB_RSM
#define LIB_RSM

#include "lib/light.glsl"

uvec4 pack_rsm(float depth, vec3 normal, vec3 relative_flux, float roughness, bool disney) {
    return uvec4(floatBitsToUint(depth), packSnorm2x16(octahedral_encode(normal)),
                 packHalf2x16(relative_flux.rg),
                 packHalf2x16(vec2(relative_flux.b, disney ? -max(roughness, 1e-3) : roughness)));
}

struct PixelLight {
    vec3 position;      // render space
    vec3 normal;        // unit
    vec3 relative_flux;
    float roughness;    // negative: Disney's diffuse lobe
    vec3 from_light;    // unit, the direction light arrives along
    float squared_distance;  // to the light; 1 for a sun
};

#ifdef READ_RSM
layout(binding = TEX_RSM) uniform usampler2DArray rsm_texture;

// The pixel light at map coordinates st (-1 to 1) of a layer. False where the map is empty.
bool read_pixel_light(vec2 st, int layer, out PixelLight p) {
    float size = light.map.x;
    ivec2 texel = clamp(ivec2((st * 0.5 + 0.5) * size), ivec2(0), ivec2(int(size) - 1));
    uvec4 bits = texelFetch(rsm_texture, ivec3(texel, layer), 0);
    float depth = uintBitsToFloat(bits.x);
    // The texel's centre, where its depth was taken.
    vec2 center = (vec2(texel) + 0.5) / size * 2.0 - 1.0;
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
    vec2 blue_roughness = unpackHalf2x16(bits.w);
    p.relative_flux = vec3(unpackHalf2x16(bits.z), blue_roughness.x);
    p.roughness = blue_roughness.y;
    return depth > 0.0;
}
#endif

#endif
