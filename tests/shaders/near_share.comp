// SPDX-License-Identifier: Apache-2.0
// In: squared distance, 1 / squared near radius; colour of a texel; light arriving there, metallic. Out: share of the
// near field; importance without and with GLOSSY as compiled.
#include "tests/harness.glsl"
#include "lib/pixel_light.glsl"
#include "lib/vpl_shading.glsl"

void test_item() {
    float density = importance_density(in_value(1).rgb, in_value(2).w, in_value(2).rgb);
    out_value(0, vec4(near_share(in_value(0).x, in_value(0).y), density, 0.0, 0.0));
}
