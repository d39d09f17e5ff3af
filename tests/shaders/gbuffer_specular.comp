// SPDX-License-Identifier: Apache-2.0
// In: specular, Disney 0 or 1. Out: what 16-bit unorm keeps of both.
#include "tests/harness.glsl"
#include "lib/gbuffer.glsl"

void test_item() {
    float stored = pack_specular(in_value(0).x, in_value(0).y > 0.5);
    float kept = unpackUnorm2x16(packUnorm2x16(vec2(stored))).x;
    float specular;
    bool disney;
    unpack_specular(kept, specular, disney);
    out_value(0, vec4(specular, disney ? 1.0 : 0.0, stored, 0.0));
}
