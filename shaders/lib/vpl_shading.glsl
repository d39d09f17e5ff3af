// SPDX-License-Identifier: Apache-2.0
//
// What a surface reflects of one virtual point light. Written for few instructions: this runs more often than
// anything else.
#ifndef LIB_VPL_SHADING
#define LIB_VPL_SHADING

#include "lib/bounced.glsl"
#include "lib/brdf.glsl"
#include "shared/types.h"

// Narrower lobes than this (roughness 0.22) between single point lights are dots, not reflections; and below it
// 1 - (n.h)^2 runs out of digits.
const float LEAST_VPL_ALPHA = 0.05;

// A light stands for a piece of surface of area A, and a glossy lobe at either end turns a row of such lights into a row of
// dots. Seen from a distance d the piece's directions spread by the variance s^2 = A / (12 d^2) along each axis if it is a
// square across the ray; half vectors by s^2 / 4. alpha^2 is twice the variance of a lobe's slopes (Beckmann's; GGX has tails besides), so a lobe that has been
// averaged over the piece has alpha^2 + A / (24 d^2) (as Hasan et al. 2009, "Virtual Spherical Lights for Many-Light
// Rendering of Glossy Scenes", average over a ball). Twice that lets neighbouring pieces overlap as a reconstruction
// filter must. The cosine of the piece to the ray is left out: at grazing angles a piece stays as long as it is.
const float WIDENING = 1.0 / 12.0;

// What of a receiver is the same for every light.
struct Receiver {
    vec3 view;          // unit, towards the viewer
    float view_fifth;   // (1 - n.v)^5
    float roughness;    // of the diffuse lobe; negative where it is Lambert's
    float n_dot_v;
    vec3 f0;
    float f90;
    float alpha2;
    float smith_view;
};

// Smith's shadowing of one direction, as a factor of the denominator of the BRDF.
float smith_term(float n_dot_x, float alpha2) {
    return n_dot_x + sqrt(n_dot_x * n_dot_x * (1.0 - alpha2) + alpha2);
}

Receiver make_receiver(Surface s, vec3 v) {
    Receiver r;
    r.view = v;
    r.n_dot_v = max(dot(s.normal, v), 1e-4);
    r.view_fifth = fifth_power(max(1.0 - r.n_dot_v, 0.0));
    r.roughness = s.disney ? s.roughness : -1.0;
    r.f0 = specular_f0(s);
    r.f90 = s.specular > 0.0 || s.metallic > 0.0 ? 1.0 : 0.0;
    float alpha = max(s.roughness * s.roughness, LEAST_VPL_ALPHA);
    r.alpha2 = alpha * alpha;
    r.smith_view = smith_term(r.n_dot_v, r.alpha2);
    return r;
}

// GGX over Smith's terms of both directions, from the cosine between them and the sum of their cosines to the
// normal. h = (a + b) / |a + b|, and |a + b|^2 = 2 + 2 a.b.
float lobe(float a_dot_b, float sum_of_cosines, float smith_a, float smith_b, float alpha2) {
    float n_dot_h2 = sum_of_cosines * sum_of_cosines / max(2.0 + 2.0 * a_dot_b, 1e-6);
    float t = 1.0 - min(n_dot_h2, 1.0) * (1.0 - alpha2);
    return alpha2 / (PI * t * t * smith_a * smith_b);
}

// A wider lobe sends more of its light below the horizon: single scattering by GGX loses about 1.2 alpha^2 of it. What
// is only spread out must not lose that, so a lobe widened by w counts for this much more.
float widening_gain(float widening) {
    return 1.0 + 1.2 * min(widening, 0.25);
}

float widened_lobe(float a_dot_b, float sum_of_cosines, float smith_a, float smith_b, float alpha2, float widening) {
    return lobe(a_dot_b, sum_of_cosines, smith_a, smith_b, min(alpha2 + widening, 1.0)) * widening_gain(widening);
}

// Rise of the Fresnel reflectance from normal incidence, 0, to grazing, 1, from the cosine between the two directions: a
// fit to that of an index of refraction of 1.5, Principled's default, with the same mean over the hemisphere (0.054) and
// 0.018 off at most. Schlick's (1 - cos)^5 has a mean of 0.048, and a rough white wall loses 0.9 % of its light by it.
float rise_between(float a_dot_b) {
    float x = 1.0 - sqrt(clamp(0.5 + 0.5 * a_dot_b, 0.0, 1.0));
    float y = x * x;
    return y * (0.14 + 0.86 * y * y);
}

float disney_factor(float roughness, float a_dot_b, float fifth_a, float fifth_b) {
    float grazing = roughness * (1.0 + a_dot_b) - 0.5;
    return (1.0 + grazing * fifth_a) * (1.0 + grazing * fifth_b);
}

// Share of a light that the near field takes over from it at a distance: all of it near by, none beyond its near
// radius, and smooth, so that neither part has an edge. Near the light what is left falls with the square of the
// distance, and with that the singularity of 1/d^2 is gone.
float near_share(float squared_distance, float inverse_squared_radius) {
    float x = max(1.0 - squared_distance * inverse_squared_radius, 0.0);
    return x * x;
}

// Light sent along the unit vector w by a light's diffuse and glossy lobes, W/sr over the cosine there. widening: added to
// alpha^2 of the glossy one.
vec3 vpl_intensity(GpuVpl vpl, vec3 w, float cos_out, float widening) {
    vec3 intensity = vpl.intensity.rgb;
#if defined(DISNEY) || defined(GLOSSY)
    float between = -dot(vpl.incident.xyz, w);
#endif
#ifdef DISNEY
    float factor = disney_factor(-vpl.normal.w, between, vpl.intensity.w, fifth_power(1.0 - cos_out));
    intensity *= vpl.normal.w < 0.0 ? factor : 1.0;
#endif
#ifdef GLOSSY
    intensity += mix(vpl.glossy.rgb, vpl.arriving.rgb, rise_between(between)) *
                 widened_lobe(between, vpl.incident.w + cos_out, vpl.arriving.w, smith_term(cos_out, vpl.glossy.w),
                              vpl.glossy.w, widening);
#endif
    return intensity;
}

// Adds a light seen along the unit vector w (from the light to the receiver), under the cosines cos_out at the
// light and cos_in at the receiver. geometry: cos cos / d^2 times what of it counts; 0 where a cosine is not
// positive. widening: added to alpha^2 of both glossy lobes.
void add_vpl(GpuVpl vpl, Receiver r, vec3 w, float cos_out, float cos_in, float geometry, float widening,
             inout BouncedLight sum) {
    vec3 arriving = vpl_intensity(vpl, w, cos_out, widening) * geometry;
    float diffuse = 1.0;
#if defined(DISNEY) || defined(GLOSSY)
    float between = -dot(r.view, w);
#endif
#ifdef DISNEY
    float factor = disney_factor(r.roughness, between, r.view_fifth, fifth_power(1.0 - cos_in));
    diffuse = r.roughness >= 0.0 ? factor : 1.0;
#endif
    sum.irradiance += arriving * diffuse;
#ifdef GLOSSY
    float f = widened_lobe(between, cos_in + r.n_dot_v, r.smith_view, smith_term(cos_in, r.alpha2), r.alpha2,
                           widening);
    sum.glossy += arriving * (mix(r.f0, vec3(r.f90), rise_between(between)) * f);
#endif
}

#endif
