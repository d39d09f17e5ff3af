// SPDX-License-Identifier: Apache-2.0
// A texel of an imperfect shadow map that shows a plane, as passes/ism_disks.comp draws it.
// In: the plane's normal and its distance from the light; the texel (x, y), texels a side of the map; a place within
// the texel (0 to 1), factor on the receiver's distance.
// Out: whether a receiver on the plane's ray there, at that factor, is lit; its distance; cosine between ray and normal;
// the unpacked distance.
#include "tests/harness.glsl"
#include "lib/ism.glsl"

void test_item() {
    vec3 normal = in_value(0).xyz;
    float plane = in_value(0).w;
    float size = in_value(1).z;
    float texel_size = 2.0 / size;
    vec2 at = (in_value(1).xy + 0.5) * texel_size - 1.0;
    float along = dot(normal, paraboloid_direction(at));
    vec2 slope = plane_slope(normal, along, at, texel_size);
    uint bits = pack_ism(plane / along, slope);
    vec2 within = in_value(2).xy;
    vec3 ray = paraboloid_direction((in_value(1).xy + within) * texel_size - 1.0);
    float distance = plane / dot(normal, ray) * in_value(2).z;
    bool lit = ism_lit(bits, distance, within - 0.5);
    bool lit_by_none = ism_lit(ISM_EMPTY, distance, within - 0.5);
    out_value(0, vec4(lit ? 1.0 : 0.0, distance, dot(normal, ray), unpackHalf2x16(bits).y));
    out_value(1, vec4(lit_by_none ? 1.0 : 0.0, along, slope));
}
