// SPDX-License-Identifier: Apache-2.0
// In: position, radius; normal, flat 0 or 1. Out: the same, packed and unpacked.
#include "tests/harness.glsl"
#include "lib/points.glsl"

void test_item() {
    SurfacePoint p;
    p.position = in_value(0).xyz;
    p.radius = in_value(0).w;
    p.normal = in_value(1).xyz;
    p.flat_surface = in_value(1).w > 0.5;
    SurfacePoint q = unpack_point(pack_point(p));
    out_value(0, vec4(q.position, q.radius));
    out_value(1, vec4(q.normal, q.flat_surface ? 1.0 : 0.0));
}
