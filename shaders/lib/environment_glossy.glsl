// SPDX-License-Identifier: Apache-2.0
//
// Glossy reflection of the world's image by the split sum (Karis 2013, "Real Shading in Unreal Engine 4"): the image
// averaged by the lobe (passes/environment_prefilter.comp) times what the lobe reflects of an even world
// (renderer/environment_brdf.h). What hides the world comes from its lights' shadow maps.
#ifndef LIB_ENVIRONMENT_GLOSSY
#define LIB_ENVIRONMENT_GLOSSY

#include "lib/brdf.glsl"
#include "lib/environment.glsl"

layout(binding = TEX_ENVIRONMENT_GLOSSY) uniform sampler2D environment_glossy_texture;
// What a lobe reflects, x: of reflectance at normal incidence, y: of its rise to grazing. Columns: cosine to the viewer,
// rows: roughness; both from 0 to 1 at the middles of the first and last texel.
layout(binding = TEX_ENVIRONMENT_BRDF) uniform sampler2D environment_brdf_texture;

// Radians over which a smooth lobe averages the image, over alpha: where a reflected ray has half of the middle's
// density. Used below ENVIRONMENT_FIRST_ROUGHNESS alone.
const float LOBE_RADIANS = 1.3;

// d: the mirrored view, unit, render space; footprint: radians between the rays of neighbouring pixels.
vec3 environment_glossy_radiance(vec3 d, float roughness, float footprint) {
    vec3 e = environment_from_render(d);
    vec3 sharp = environment_radiance(e, max(footprint * 0.5, LOBE_RADIANS * roughness * roughness));
    const float first = ENVIRONMENT_FIRST_ROUGHNESS;
    float rough = clamp((roughness - first) / (1.0 - first), 0.0, 1.0) * world.detail.z;
    // Coarse levels of an equirectangular image have their first and last row a texel's half away from the poles.
    vec3 wide = textureLod(environment_glossy_texture, environment_place(e), rough).rgb * world.environment_from_render[0].w;
    return mix(sharp, wide, smoothstep(0.5 * first, first, roughness));
}

vec3 environment_glossy(Surface s, vec3 v, float footprint) {
    float n_dot_v = clamp(dot(s.normal, v), 0.0, 1.0);
    vec2 size = vec2(textureSize(environment_brdf_texture, 0));
    vec2 place = (vec2(n_dot_v, s.roughness) * (size - 1.0) + 0.5) / size;
    vec2 part = textureLod(environment_brdf_texture, place, 0.0).rg;
    vec3 f0 = specular_f0(s);
    float f90 = s.specular > 0.0 || s.metallic > 0.0 ? 1.0 : 0.0;
    vec3 mirrored = reflect(-v, s.normal);
    return environment_glossy_radiance(mirrored, s.roughness, footprint) * (f0 * part.x + vec3(f90) * part.y);
}

#endif
