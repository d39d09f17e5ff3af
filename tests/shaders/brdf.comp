// SPDX-License-Identifier: Apache-2.0
// In: base colour and roughness; metallic, specular, -, -; l; v (both about the normal +Z). Out: GGX times cosine.
#include "tests/harness.glsl"
#include "lib/brdf.glsl"

void test_item() {
    Surface s;
    s.position = vec3(0.0);
    s.normal = vec3(0.0, 0.0, 1.0);
    s.base_color = in_value(0).rgb;
    s.roughness = in_value(0).a;
    s.metallic = in_value(1).x;
    s.specular = in_value(1).y;
    s.disney = false;
    out_value(0, vec4(specular_times_cosine(s, in_value(2).xyz, in_value(3).xyz), 0.0));
}
