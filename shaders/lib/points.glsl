// SPDX-License-Identifier: Apache-2.0
//
// A point of the scene's surfaces at this pose, in one uvec4:
//   x y z  position, render space, float bits
//   w      radius (half, negative on a large plane) and octahedral normal (2 x 8 bit snorm)
// The radius is that of a disk of the area that the point stands for in its whole sequence; 0 where its surface
// is not drawn.
#ifndef LIB_POINTS
#define LIB_POINTS

#include "lib/math.glsl"
#include "shared/bindings.h"

struct SurfacePoint {
    vec3 position;
    vec3 normal;  // the triangle's own, on no particular side
    float radius;
    bool flat_surface;  // on a large plane, so that a disk around the point lies in the surface
};

uvec4 pack_point(SurfacePoint p) {
    vec2 octahedral = octahedral_encode(p.normal);
    uint normal = (uint(int(round(octahedral.x * 127.0))) & 0xffu) |
                  ((uint(int(round(octahedral.y * 127.0))) & 0xffu) << 8);
    return uvec4(floatBitsToUint(p.position), packHalf2x16(vec2(p.flat_surface ? -p.radius : p.radius, 0.0)) | (normal << 16));
}

SurfacePoint unpack_point(uvec4 bits) {
    SurfacePoint p;
    p.position = uintBitsToFloat(bits.xyz);
    float radius = unpackHalf2x16(bits.w).x;
    p.radius = abs(radius);
    p.flat_surface = radius < 0.0;
    ivec2 octahedral = ivec2(int(bits.w << 8) >> 24, int(bits.w) >> 24);
    p.normal = octahedral_decode(vec2(octahedral) / 127.0);
    return p;
}

#endif
