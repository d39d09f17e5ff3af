// SPDX-License-Identifier: Apache-2.0
//
// A virtual point light from a texel of a reflective map.
#ifndef LIB_VPL_MAKE
#define LIB_VPL_MAKE

#include "lib/pixel_light.glsl"
#include "lib/vpl_shading.glsl"

GpuVpl dark_vpl() {
    GpuVpl vpl;
    vpl.position = vec4(0.0);
    vpl.normal = vec4(0.0, 0.0, 1.0, 0.0);
    vpl.tangent = vec4(1.0, 0.0, 0.0, 1e30);
    vpl.bitangent = vec4(0.0, 1.0, 0.0, 0.0);
    vpl.intensity = vec4(0.0);
    vpl.incident = vec4(0.0, 0.0, -1.0, 1.0);
    vpl.glossy = vec4(0.0, 0.0, 0.0, 1.0);
    vpl.arriving = vec4(0.0, 0.0, 0.0, 1.0);
    return vpl;
}

// Reach of a light's near field over the side of the square it stands for: at three sides a light is one of a dozen or
// two that light a receiver alike, and no longer a spot. docs/papers/imperfect_shadow_maps.md has the measurement.
const float NEAR_RADIUS = 3.0;

// The light that stands for `measure` of the map (solid angle, or area across a sun's rays) around the texel.
// Its near radius and its map are left to the caller.
GpuVpl make_vpl(PixelLight p, float measure) {
    GpuVpl vpl;
    vec3 t;
    vec3 b;
    orthonormal_basis(p.normal, t, b);
    vec3 flux = p.arriving * measure;
    float cos_incident = max(-dot(p.normal, p.from_light), 1e-4);
    vpl.position = vec4(p.position, surface_area(p, measure));
    vpl.normal = vec4(p.normal, p.disney ? -max(p.roughness, 1e-3) : p.roughness);
    vpl.tangent = vec4(t, 1e30);
    vpl.bitangent = vec4(b, 0.0);
    vpl.intensity = vec4(p.color * flux * ((1.0 - p.metallic) / PI), fifth_power(max(1.0 - cos_incident, 0.0)));
    vpl.incident = vec4(p.from_light, cos_incident);
    vpl.glossy = vec4(0.0, 0.0, 0.0, 1.0);
    vpl.arriving = vec4(0.0, 0.0, 0.0, 1.0);
#ifdef GLOSSY
    float alpha = max(p.roughness * p.roughness, LEAST_VPL_ALPHA);
    float alpha2 = alpha * alpha;
    vpl.glossy = vec4(mix(vec3(0.08 * p.specular * p.profile), p.color, p.metallic) * flux, alpha2);
    // A surface without any specular reflectance has no rise towards grazing either.
    vpl.arriving = vec4(flux * (p.specular > 0.0 || p.metallic > 0.0 ? p.profile : 0.0),
                        smith_term(cos_incident, alpha2));
#endif
    return vpl;
}

#endif
