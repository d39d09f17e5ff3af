// SPDX-License-Identifier: Apache-2.0
// In: number of a draw and of a triangle, points it is to have, maps. Out: its points and first map, their seed's low
// 16 bits; and the place of the map's index-th point (in: seed, map, index).
#include "tests/harness.glsl"
#include "lib/patch_points.glsl"

void test_item() {
    PatchPoints p = patch_points(uint(in_value(0).x), uint(in_value(0).y), in_value(0).z, in_value(0).w);
    vec2 at = place_on_triangle(uint(in_value(1).x), uint(in_value(1).y), uint(in_value(1).z));
    out_value(0, vec4(p.count, p.first_map, p.seed & 0xffffu, p.seed >> 16));
    out_value(1, vec4(at, 0.0, 0.0));
}
