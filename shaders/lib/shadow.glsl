// SPDX-License-Identifier: Apache-2.0
#ifndef LIB_SHADOW
#define LIB_SHADOW

#include "lib/light.glsl"

layout(binding = TEX_SHADOW) uniform sampler2DArrayShadow shadow_texture;

// How far the filter below reaches from a point's place in the map, in texels, along s and along t.
const float SHADOW_REACH = 1.5;

// Rounding of positions in render space, whose unit is the scene's diagonal: a few steps of a float at 1. Each
// comparison gives a receiver this much, so that a surface does not shadow itself by rounding alone.
const float POSITION_ROUNDING = 1e-6;

// Share of the light that reaches a surface point, by 3 x 3 texels around it.
//
// A texel holds the depth of the receiver where the texel's own ray meets it, not where ours does. On a
// receiver plane with unit normal n, at depth z along the map's axis, a step (ds, dt) in the map changes that
// depth by the factor 1 - n.(ds, dt, 0) / n.(s, t, 1). The point is lifted along n by h, which changes its
// depth by the factor 1 - h / |z n.(s, t, 1)|: so h = z (|n_s| ds + |n_t| dt) clears the filter's reach
// exactly. It is zero where the receiver lies across the map's axis, and nowhere larger than it has to be.
// normal is the triangle's own; n_s and n_t are along the map's own axes, for a cube those of the face.
float light_visibility(vec3 position, vec3 normal) {
    vec3 p = light_from_render(position);
    vec3 n = abs(vec3(dot(normal, light.tangent.xyz), dot(normal, light.bitangent.xyz),
                      dot(normal, light.axis.xyz)));
    float size = light.map.y;
#if MAP_KIND == MAP_ORTHOGRAPHIC
    float lift = 2.0 * (n.x * light.tangent.w + n.y * light.bitangent.w) / size;
#elif MAP_KIND == MAP_PERSPECTIVE
    float lift = 2.0 * (n.x + n.y) * light.axis.w * max(p.z, 0.0) / size;
#else
    vec3 a = abs(p);
    float depth_at = max(max(a.x, a.y), a.z);
    float along = a.x == depth_at ? n.x : a.y == depth_at ? n.y : n.z;
    float lift = 2.0 * (n.x + n.y + n.z - along) * depth_at / size;
#endif
    p = light_from_render(position + normal * (SHADOW_REACH * lift));
    float face = 0.0;
    vec2 st;
    float reference;
#if MAP_KIND == MAP_ORTHOGRAPHIC
    st = p.xy / vec2(light.tangent.w, light.bitangent.w);
    reference = 1.0 - (p.z - POSITION_ROUNDING) / light.map.z;
#elif MAP_KIND == MAP_PERSPECTIVE
    if (p.z <= 0.0) {
        return 0.0;
    }
    st = p.xy / (p.z * light.axis.w);
    reference = light.map.z / max(p.z - POSITION_ROUNDING, 1e-30);
#else
    int index;
    float depth;
    cube_face(p, index, st, depth);
    face = float(index);
    reference = light.map.z / max(depth - POSITION_ROUNDING, 1e-30);
#endif
    // The map's depth is a rounded float as well: a few of its steps.
    reference = min(reference * (1.0 + 4e-6), 1.0);
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
