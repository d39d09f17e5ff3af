// SPDX-License-Identifier: Apache-2.0
// In: a unit vector. Out: its code; decoded from the code as it is, from 16-bit unorm, from 16-bit snorm.
#include "tests/harness.glsl"
#include "lib/math.glsl"

void test_item() {
    vec3 n = in_value(0).xyz;
    vec2 e = octahedral_encode(n);
    out_value(0, vec4(e, 0.0, 0.0));
    out_value(1, vec4(octahedral_decode(e), 0.0));
    // What an RGBA16 render target keeps of e * 0.5 + 0.5.
    vec2 unorm = unpackUnorm2x16(packUnorm2x16(e * 0.5 + 0.5));
    out_value(2, vec4(octahedral_decode(unorm * 2.0 - 1.0), 0.0));
    out_value(3, vec4(octahedral_decode(unpackSnorm2x16(packSnorm2x16(e))), 0.0));
}
