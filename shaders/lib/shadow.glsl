// SPDX-License-Identifier: Apache-2.0
#ifndef LIB_SHADOW
#define LIB_SHADOW

#include "lib/light.glsl"

layout(binding = TEX_SHADOW) uniform sampler2DArrayShadow shadow_texture;

// Share of the light that reaches a surface point, by 3 x 3 texels around it.
//
// A texel of the map covers a patch of the receiver; comparing one depth over that patch shadows the
// receiver by itself by up to the patch's depth range. The point is therefore lifted along the normal by
// what the filter reaches (1.5 texels, and half for the rounding of the position to a texel centre), times
// the sine of the incidence, which is the lift that clears the patch exactly; facing the light it is zero.
float light_visibility(vec3 position, vec3 normal, vec3 to_light) {
    vec3 p = light_from_render(position);
    float size = light.map.y;
#if MAP_KIND == MAP_ORTHOGRAPHIC
    float texel = 2.0 * light.tangent.w / size;
#elif MAP_KIND == MAP_PERSPECTIVE
    float texel = 2.0 * light.axis.w * max(p.z, 0.0) / size;
#else
    float texel = 2.0 * max(max(abs(p.x), abs(p.y)), abs(p.z)) / size;
#endif
    float cosine = clamp(dot(normal, to_light), 0.0, 1.0);
    float sine = sqrt(1.0 - cosine * cosine);
    p = light_from_render(position + normal * (2.0 * texel * sine));
    float face = 0.0;
    vec2 st;
    float reference;
#if MAP_KIND == MAP_ORTHOGRAPHIC
    st = p.xy / vec2(light.tangent.w, light.bitangent.w);
    reference = 1.0 - p.z / light.map.z;
#elif MAP_KIND == MAP_PERSPECTIVE
    if (p.z <= 0.0) {
        return 0.0;
    }
    st = p.xy / (p.z * light.axis.w);
    reference = light.map.z / p.z;
#else
    int index;
    float depth;
    cube_face(p, index, st, depth);
    face = float(index);
    reference = light.map.z / max(depth, 1e-30);
#endif
    // Depth is rounded to float; a few of its steps at this depth keep equal surfaces lit.
    reference = min(reference * (1.0 + 4e-6) + 1e-7, 1.0);
    vec2 uv = st * 0.5 + 0.5;
    float step = 0.5 / size;
    float lit = 0.0;
    lit += texture(shadow_texture, vec4(uv + vec2(-step, -step), face, reference));
    lit += texture(shadow_texture, vec4(uv + vec2(step, -step), face, reference));
    lit += texture(shadow_texture, vec4(uv + vec2(-step, step), face, reference));
    lit += texture(shadow_texture, vec4(uv + vec2(step, step), face, reference));
    return 0.25 * lit;
}

#endif
