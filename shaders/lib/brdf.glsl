// SPDX-License-Identifier: Apache-2.0
#ifndef LIB_BRDF
#define LIB_BRDF

#include "lib/math.glsl"

float fifth_power(float x) {
    float x2 = x * x;
    return x2 * x2 * x;
}

// Factor of Disney's diffuse lobe over Lambert's (Burley 2012, "Physically Based Shading at Disney"); the
// Principled BSDF of Blender before 4.0 has it. l and v are unit vectors away from the surface.
float disney_diffuse_factor(float n_dot_l, float n_dot_v, float l_dot_v, float roughness) {
    // cos^2 of the half angle between l and v.
    float cos2_half = 0.5 * (1.0 + l_dot_v);
    float grazing = 2.0 * roughness * cos2_half - 0.5;  // FD90 - 1
    float from_l = fifth_power(clamp(1.0 - n_dot_l, 0.0, 1.0));
    float from_v = fifth_power(clamp(1.0 - n_dot_v, 0.0, 1.0));
    return (1.0 + grazing * from_l) * (1.0 + grazing * from_v);
}

// Unpolarised Fresnel reflectance of a dielectric with relative index of refraction eta.
float dielectric_fresnel(float cos_i, float eta) {
    float g2 = eta * eta - 1.0 + cos_i * cos_i;
    if (g2 <= 0.0) {
        return 1.0;
    }
    float g = sqrt(g2);
    float a = (g - cos_i) / (g + cos_i);
    float b = (cos_i * (g + cos_i) - 1.0) / (cos_i * (g - cos_i) + 1.0);
    return 0.5 * a * a * (1.0 + b * b);
}

struct Surface {
    vec3 position;  // render space
    vec3 normal;    // unit, facing the viewer
    vec3 base_color;
    float metallic;
    float roughness;
    float specular;
    bool disney;
};

// Reflectance of the glossy lobe at normal incidence.
vec3 specular_f0(Surface s) {
    return mix(vec3(0.08 * s.specular), s.base_color, s.metallic);
}

vec3 diffuse_albedo(Surface s) {
    return s.base_color * (1.0 - s.metallic);
}

// GGX distribution and Smith's shadowing, as factors of the BRDF: D V, with the 1 / (4 n.l n.v) in V (Walter et
// al. 2007, "Microfacet Models for Refraction through Rough Surfaces"). Shadowing towards light and viewer is
// independent, as in Cycles before 4.0: at 75 degrees and roughness 1 it is a third darker than the
// height-correlated kind (measured in docs/lights.md). n_cross_h: n x h, because 1 - (n.h)^2 as a difference has
// no digits left where a highlight is narrow.
float ggx_distribution_visibility(float n_dot_l, float n_dot_v, float n_dot_h, vec3 n_cross_h, float alpha) {
    float alpha2 = alpha * alpha;
    float t = n_dot_h * n_dot_h * alpha2 + dot(n_cross_h, n_cross_h);
    float smith_l = n_dot_l + sqrt(n_dot_l * n_dot_l * (1.0 - alpha2) + alpha2);
    float smith_v = n_dot_v + sqrt(n_dot_v * n_dot_v * (1.0 - alpha2) + alpha2);
    return alpha2 / max(PI * t * t * smith_l * smith_v, 1e-20);
}

// Index of refraction of a dielectric from its reflectance at normal incidence, 0.08 * specular.
float dielectric_eta(float f0) {
    float root = sqrt(clamp(f0, 0.0, 0.99));
    return max((1.0 + root) / (1.0 - root), 1.0001);
}

// How far the Fresnel reflectance has risen from its value at normal incidence, 0, to grazing, 1.
float fresnel_rise(float cos_i, float eta) {
    float f0 = (eta - 1.0) * (eta - 1.0) / ((eta + 1.0) * (eta + 1.0));
    return clamp((dielectric_fresnel(cos_i, eta) - f0) / (1.0 - f0), 0.0, 1.0);
}

// GGX reflection times the cosine at the receiver for a reflectance of 1; l and v unit.
float ggx_times_cosine(Surface s, vec3 l, vec3 v) {
    float n_dot_l = dot(s.normal, l);
    float n_dot_v = max(dot(s.normal, v), 1e-4);
    if (n_dot_l <= 0.0) {
        return 0.0;
    }
    // Below this a highlight is narrower than float resolves; Cycles treats such surfaces as mirrors, which
    // lights without size do not show in.
    float alpha = max(s.roughness * s.roughness, 1e-3);
    vec3 h = safe_normalize(l + v, s.normal);
    float n_dot_h = clamp(dot(s.normal, h), 0.0, 1.0);
    return ggx_distribution_visibility(n_dot_l, n_dot_v, n_dot_h, cross(s.normal, h), alpha) * n_dot_l;
}

// Reflectance of the microfacets that mirror l to v. F0 and its rise to 1 follow the Principled BSDF: 0.08 * specular
// for dielectrics, the base colour for metals, scaled by the exact Fresnel curve.
vec3 specular_fresnel(Surface s, vec3 l, vec3 v) {
    vec3 h = safe_normalize(l + v, s.normal);
    float rise = fresnel_rise(clamp(dot(h, v), 0.0, 1.0), dielectric_eta(0.08 * s.specular));
    return s.specular > 0.0 || s.metallic > 0.0 ? mix(specular_f0(s), vec3(1.0), rise) : vec3(0.0);
}

// BRDF * n.l.
vec3 specular_times_cosine(Surface s, vec3 l, vec3 v) {
    return specular_fresnel(s, l, v) * ggx_times_cosine(s, l, v);
}

#endif
