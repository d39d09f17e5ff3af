// SPDX-License-Identifier: Apache-2.0
//
// Bounced light of a pixel between the gather and the picture, in one RGBA32UI texel:
//   x  irradiance, red and green, halves
//   y  irradiance, blue; glossy radiance, red
//   z  glossy radiance, green and blue
//   w  the pixel's depth, float bits; 0 where it shows no surface
// Values are times frame.composite.w, so that no power of the lights leaves a half's range. They are read and
// written as images: on llvmpipe a plain load costs a third of a texel fetch.
#ifndef LIB_BOUNCED
#define LIB_BOUNCED

struct BouncedLight {
    vec3 irradiance;  // times the diffuse lobe's factors
    vec3 glossy;      // radiance of glossy reflection
};

uvec4 pack_bounced(BouncedLight b, float depth) {
    const vec3 most = vec3(65504.0);
    vec3 i = min(b.irradiance, most);
    vec3 g = min(b.glossy, most);
    return uvec4(packHalf2x16(i.rg), packHalf2x16(vec2(i.b, g.r)), packHalf2x16(g.gb), floatBitsToUint(depth));
}

BouncedLight unpack_bounced(uvec4 bits) {
    vec2 middle = unpackHalf2x16(bits.y);
    BouncedLight b;
    b.irradiance = vec3(unpackHalf2x16(bits.x), middle.x);
    b.glossy = vec3(middle.y, unpackHalf2x16(bits.z));
    return b;
}

#endif
