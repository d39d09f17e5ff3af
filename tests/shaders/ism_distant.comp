// SPDX-License-Identifier: Apache-2.0
// A texel of a distant light's shadow map that shows a plane, as passes/ism_disks.comp draws it, in units of the map's
// reach.
// In: the plane's depth at the texel's centre, its slopes along s and t, texels a side; a place within the texel (0 to
// 1), how far the receiver lies behind the plane there.
// Out: whether it is lit; whether it is with an empty texel.
#include "tests/harness.glsl"
#include "lib/ism.glsl"

void test_item() {
    vec4 plane = in_value(0);
    vec2 from_center = in_value(1).xy - 0.5;
    uint bits = pack_distant(plane.x, plane.yz, plane.w);
    float depth = plane.x + dot(plane.yz, from_center) * 2.0 / plane.w + in_value(1).z;
    out_value(0, vec4(distant_lit(bits, depth, from_center, plane.w) ? 1.0 : 0.0,
                      distant_lit(ISM_EMPTY, depth, from_center, plane.w) ? 1.0 : 0.0, 0.0, 0.0));
}
