// SPDX-License-Identifier: Apache-2.0
//
// Glossy reflection of the world's image by the split sum (Karis 2013, "Real Shading in Unreal Engine 4"): the image
// averaged by the lobe (passes/environment_prefilter.comp) times what the lobe reflects of an even world
// (gpu/environment_brdf.h). What hides the world comes from its lights' shadow maps.
#ifndef LIB_ENVIRONMENT_GLOSSY
#define LIB_ENVIRONMENT_GLOSSY

#include "lib/brdf.glsl"
#include "lib/environment.glsl"

layout(binding = TEX_ENVIRONMENT_GLOSSY) uniform sampler2D environment_glossy_texture;
// What a lobe reflects, x: of reflectance at normal incidence, y: of its rise to grazing; z, w: the lobe's first moment, as
// gpu/environment_brdf.h has it. Columns: cosine to the viewer, rows: roughness; both from 0 to 1 at the middles of the
// first and last texel.
layout(binding = TEX_ENVIRONMENT_BRDF) uniform sampler2D environment_brdf_texture;

// Radians over which a smooth lobe averages the image, over alpha: where a reflected ray has half of the middle's
// density. Used below ENVIRONMENT_FIRST_ROUGHNESS alone.
const float LOBE_RADIANS = 1.3;

// Where a roughness lies among the levels, which are even steps of its logarithm. Between two of them the weights give
// the middle of the lobe its height, which goes with 1/alpha^2: by half of each a small sun's reflection would be far too
// bright.
float rough_level(float roughness) {
    const float first = ENVIRONMENT_FIRST_ROUGHNESS;
    float r = clamp(roughness, first, 1.0);
    float step_log = -log(first) / world.detail.z;
    float level = min(floor(log(r / first) / step_log), world.detail.z - 1.0);
    float low = exp(-4.0 * log(first) - 4.0 * level * step_log);
    float high = low * exp(-4.0 * step_log);
    return level + clamp((low - 1.0 / (r * r * r * r)) / (low - high), 0.0, 1.0);
}

// d: the mirrored view, unit, render space; footprint: radians between the rays of neighbouring pixels.
vec3 environment_glossy_radiance(vec3 d, float roughness, float footprint) {
    vec3 e = environment_from_render(d);
    vec3 sharp = environment_radiance(e, max(footprint, LOBE_RADIANS * roughness * roughness));
    const float first = ENVIRONMENT_FIRST_ROUGHNESS;
    vec3 wide = textureLod(environment_glossy_texture, environment_place(e), rough_level(roughness)).rgb *
                world.environment_from_render[0].w;
    return mix(sharp, wide, smoothstep(0.5 * first, first, roughness));
}

vec3 environment_glossy(Surface s, vec3 v, float footprint) {
    float n_dot_v = clamp(dot(s.normal, v), 0.0, 1.0);
    vec2 size = vec2(textureSize(environment_brdf_texture, 0));
    vec2 place = (vec2(n_dot_v, s.roughness) * (size - 1.0) + 0.5) / size;
    vec4 part = textureLod(environment_brdf_texture, place, 0.0);
    vec3 f0 = specular_f0(s);
    float f90 = s.specular > 0.0 || s.metallic > 0.0 ? 1.0 : 0.0;
    // A rough lobe seen from aside leans to the normal and is cut off at the horizon: the lobe seen head on that has the same
    // first moment stands for it.
    vec3 mirrored = reflect(-v, s.normal);
    vec3 lean = s.normal - n_dot_v * mirrored;
    vec3 middle = cos(part.z) * mirrored + sin(part.z) / max(length(lean), 1e-4) * lean;
    return environment_glossy_radiance(normalize(middle), part.w, footprint) * (f0 * part.x + vec3(f90) * part.y);
}

#endif
