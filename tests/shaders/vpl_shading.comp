// SPDX-License-Identifier: Apache-2.0
// A virtual point light on a surface with the normal +Z and a receiver, each by lib/vpl_shading.glsl (with GLOSSY and
// DISNEY as defined) and by the whole functions of lib/brdf.glsl.
// In: base colour and roughness; metallic, specular, Disney 0 or 1, cosine a^.b for the rise; direction towards the
// light's source; direction of the light sent out; the receiver's view (about the normal +Z), its n.l.
// Out: BRDF of the light, then of the receiver, diffuse lobes; the same, glossy ones, without Fresnel's rise (as of a
// white metal); rise, exact rise; all of the light at once.
#include "tests/harness.glsl"
#include "lib/vpl_make.glsl"

vec3 diffuse(Surface s, vec3 l, vec3 v) {
    float factor = s.disney ? disney_diffuse_factor(s.normal.z * l.z, v.z, dot(l, v), s.roughness) : 1.0;
    return diffuse_albedo(s) / PI * factor;
}

void test_item() {
    Surface s;
    s.position = vec3(0.0);
    s.normal = vec3(0.0, 0.0, 1.0);
    s.base_color = in_value(0).rgb;
    s.roughness = in_value(0).a;
    s.metallic = in_value(1).x;
    s.specular = in_value(1).y;
    s.disney = in_value(1).z > 0.5;
    vec3 l = in_value(2).xyz;
    vec3 v = in_value(3).xyz;

    // The light: v leaves it, light arrives from l.
    PixelLight p;
    p.position = vec3(0.0);
    p.normal = s.normal;
    p.color = s.base_color;
    p.roughness = s.roughness;
    p.metallic = s.metallic;
    p.specular = s.specular;
    p.disney = s.disney;
    p.from_light = -l;
    p.squared_distance = 1.0;
    p.arriving = vec3(3.0);
    p.profile = 1.0;
    p.area = 0.0;
    GpuVpl vpl = make_vpl(p, 0.25);
    vec3 sent = vpl_intensity(vpl, v, v.z, 0.0) / (3.0 * 0.25);
    vec3 exact = diffuse(s, l, v) + specular_times_cosine(s, l, v) / l.z;
    out_value(0, vec4(sent, 0.0));
    out_value(1, vec4(exact, 0.0));

    // The receiver: light from l, seen from v. The light sends 1.
    GpuVpl white = vpl;
    white.normal.w = 1.0;
    white.intensity = vec4(1.0, 1.0, 1.0, 0.0);
    white.glossy = vec4(0.0, 0.0, 0.0, 1.0);
    white.arriving = vec4(0.0, 0.0, 0.0, 1.0);
    Receiver r = make_receiver(s, v);
    BouncedLight sum;
    sum.irradiance = vec3(0.0);
    sum.glossy = vec3(0.0);
    add_vpl(white, r, -l, 1.0, l.z, l.z, 0.0, sum);
    out_value(2, vec4(diffuse_albedo(s) / PI * sum.irradiance + sum.glossy, 0.0));
    out_value(3, vec4(exact * l.z, 0.0));

    float cos_half = sqrt(0.5 + 0.5 * in_value(1).w);
    out_value(4, vec4(rise_between(in_value(1).w), fresnel_rise(cos_half, dielectric_eta(0.04)), 0.0, 0.0));
    out_value(5, vpl.position);
}
