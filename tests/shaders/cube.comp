// SPDX-License-Identifier: Apache-2.0
// In: a vector. Out: face, s, t, depth of its place in a cube map; the direction of that place.
#include "tests/harness.glsl"
#include "lib/light.glsl"

void test_item() {
    int face;
    vec2 st;
    float depth;
    cube_face(in_value(0).xyz, face, st, depth);
    out_value(0, vec4(float(face), st, depth));
    out_value(1, vec4(cube_direction(face, st), 0.0));
}
