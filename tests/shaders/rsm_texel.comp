// SPDX-License-Identifier: Apache-2.0
// PACK: in depth, metallic, specular, roughness; normal, Disney 0 or 1; base colour. Out: the texel's bits.
// Otherwise: in s, t, layer. Out what a gather sample reads there: position and whether there is one, normal,
// colour and roughness, direction and squared distance from the light, metallic, specular and diffuse model.
#include "tests/harness.glsl"
#ifndef PACK
#define READ_RSM
#endif
#include "lib/rsm.glsl"

void test_item() {
#ifdef PACK
    Surface s;
    s.position = vec3(0.0);
    s.normal = in_value(1).xyz;
    s.base_color = in_value(2).rgb;
    s.metallic = in_value(0).y;
    s.roughness = in_value(0).w;
    s.specular = in_value(0).z;
    s.disney = in_value(1).w > 0.5;
    // The profile multiplies the stored colour.
    uvec4 bits = pack_rsm(in_value(0).x, s, in_value(2).w);
    out_value(0, uintBitsToFloat(bits));
#else
    PixelLight p;
    bool hit = read_pixel_light(in_value(0).xy, int(in_value(0).z), p);
    out_value(0, vec4(p.position, hit ? 1.0 : 0.0));
    out_value(1, vec4(p.normal, 0.0));
    out_value(2, vec4(p.color, p.roughness));
    out_value(3, vec4(p.from_light, p.squared_distance));
    out_value(4, vec4(p.metallic, p.specular, p.disney ? 1.0 : 0.0, 0.0));
#endif
}
