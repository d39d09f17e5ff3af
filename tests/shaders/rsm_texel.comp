// SPDX-License-Identifier: Apache-2.0
// PACK: in depth, -, -, roughness; normal, Disney 0 or 1; relative flux. Out: the texel's bits.
// Otherwise: in s, t, layer. Out what a gather sample reads there: position and whether there is one, normal,
// flux and roughness, direction and squared distance from the light.
#include "tests/harness.glsl"
#ifndef PACK
#define READ_RSM
#endif
#include "lib/rsm.glsl"

void test_item() {
#ifdef PACK
    uvec4 bits = pack_rsm(in_value(0).x, in_value(1).xyz, in_value(2).rgb, in_value(0).w, in_value(1).w > 0.5);
    out_value(0, uintBitsToFloat(bits));
#else
    PixelLight p;
    bool hit = read_pixel_light(in_value(0).xy, int(in_value(0).z), p);
    out_value(0, vec4(p.position, hit ? 1.0 : 0.0));
    out_value(1, vec4(p.normal, 0.0));
    out_value(2, vec4(p.relative_flux, p.roughness));
    out_value(3, vec4(p.from_light, p.squared_distance));
#endif
}
