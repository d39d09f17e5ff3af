// SPDX-License-Identifier: Apache-2.0
// In: n.l, n.v, l.v, roughness; cos of incidence, index of refraction. Out: Disney's factor, Fresnel's reflectance.
#include "tests/harness.glsl"
#include "lib/brdf.glsl"

void test_item() {
    vec4 a = in_value(0);
    vec4 b = in_value(1);
    out_value(0, vec4(disney_diffuse_factor(a.x, a.y, a.z, a.w), dielectric_fresnel(b.x, b.y), 0.0, 0.0));
}
