// SPDX-License-Identifier: Apache-2.0
// In: base colour and roughness; metallic, specular, 1 where the light is round, -; v; the light's middle and half
// extents (normal +Z). Out: what the lobe reflects of the light at radiance 1, share; mean direction.
#include "tests/harness.glsl"
#include "lib/lobe.glsl"

void test_item() {
    Surface s;
    s.position = vec3(0.0);
    s.normal = vec3(0.0, 0.0, 1.0);
    s.base_color = in_value(0).rgb;
    s.roughness = in_value(0).a;
    s.metallic = in_value(1).x;
    s.specular = in_value(1).y;
    s.disney = false;
    FlatLight light = FlatLight(in_value(3).xyz, in_value(4).xyz, in_value(5).xyz, in_value(1).z > 0.5);
    Reflected found = reflected_flat_light(s, in_value(2).xyz, light);
    out_value(0, vec4(found.radiance, found.share));
    out_value(1, vec4(found.toward, 0.0));
}
