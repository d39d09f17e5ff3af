// SPDX-License-Identifier: Apache-2.0
// In: roughness, widening, -, -; l; v (both about the normal +Z). Out: what a white metal at the normal reflects towards
// v of a virtual light of 1 W/sr in direction l; what such a metal, lit along -l, sends towards v as a virtual light.
// Both times the cosine of l.
#define GLOSSY
#include "tests/harness.glsl"
#include "lib/vpl_shading.glsl"

void test_item() {
    float roughness = in_value(0).x;
    float widening = in_value(0).y;
    vec3 l = in_value(1).xyz;
    vec3 v = in_value(2).xyz;
    Surface s;
    s.position = vec3(0.0);
    s.normal = vec3(0.0, 0.0, 1.0);
    s.base_color = vec3(1.0);
    s.roughness = roughness;
    s.metallic = 1.0;
    s.specular = 0.5;
    s.disney = false;
    GpuVpl vpl;
    vpl.intensity = vec4(1.0, 1.0, 1.0, 0.0);
    vpl.incident = vec4(0.0, 0.0, -1.0, 1.0);
    vpl.glossy = vec4(0.0, 0.0, 0.0, 1.0);
    vpl.arriving = vec4(0.0, 0.0, 0.0, 1.0);
    BouncedLight sum;
    sum.irradiance = vec3(0.0);
    sum.glossy = vec3(0.0);
    add_vpl(vpl, make_receiver(s, v), -l, 1.0, l.z, l.z, widening, sum);

    float alpha2 = roughness * roughness * roughness * roughness;
    vpl.intensity = vec4(0.0);
    vpl.incident = vec4(-l, l.z);
    vpl.glossy = vec4(1.0, 1.0, 1.0, alpha2);
    vpl.arriving = vec4(1.0, 1.0, 1.0, smith_term(l.z, alpha2));
    out_value(0, vec4(sum.glossy.r, vpl_intensity(vpl, v, v.z, widening).r * l.z, 0.0, 0.0));
}
