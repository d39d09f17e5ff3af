// SPDX-License-Identifier: Apache-2.0
// In: irradiance, depth; glossy. Out: the same, packed and unpacked.
#include "tests/harness.glsl"
#include "lib/bounced.glsl"

void test_item() {
    BouncedLight b;
    b.irradiance = in_value(0).rgb;
    b.glossy = in_value(1).rgb;
    uvec4 bits = pack_bounced(b, in_value(0).w);
    BouncedLight c = unpack_bounced(bits);
    out_value(0, vec4(c.irradiance, uintBitsToFloat(bits.w)));
    out_value(1, vec4(c.glossy, 0.0));
}
