// SPDX-License-Identifier: Apache-2.0
#ifndef LIB_PIXEL_LIGHT
#define LIB_PIXEL_LIGHT

// A texel of a reflective map as a source of bounced light.
struct PixelLight {
    vec3 position;  // render space
    vec3 normal;    // unit
    vec3 color;     // base colour * profile: what a white surface would reflect, relative to `arriving`
    float roughness;
    float metallic;
    float specular;
    bool disney;
    vec3 from_light;         // unit, the direction light arrives along
    float squared_distance;  // to the light; 1 for a sun
    vec3 arriving;           // light sent towards it, W/sr (sun: W/m^2), before the profile
    float profile;           // of the light towards it; 1 where only diffuse reflection is asked for
    float area;              // of surface; only where the map says so (lib/irsm.glsl)
};

// Surface area at a texel for what it measures in the map: solid angle, or area across a sun's rays.
float surface_area(PixelLight p, float measure) {
    // A texel seen at a grazing angle says little about how far its surface goes on.
    return measure * p.squared_distance / max(-dot(p.normal, p.from_light), 0.1);
}

// Luminance of what it reflects for a unit of what it measures; of the glossy lobe about as much as at normal
// incidence. It decides how often virtual point lights are drawn there.
float importance_density(vec3 color, float metallic, vec3 arriving) {
#ifdef GLOSSY
    vec3 reflected = color;
#else
    vec3 reflected = color * (1.0 - metallic);
#endif
    return max(dot(reflected * arriving, vec3(0.2126, 0.7152, 0.0722)), 0.0);
}

#endif
