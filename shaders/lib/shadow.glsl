// SPDX-License-Identifier: Apache-2.0
#ifndef LIB_SHADOW
#define LIB_SHADOW

#include "lib/light.glsl"

layout(binding = TEX_SHADOW) uniform sampler2DArray shadow_texture;

// Rounding of positions in render space, whose unit is the scene's diagonal: a few steps of a float at 1. Each
// comparison gives a receiver this much, so that a surface does not shadow itself by rounding alone.
const float POSITION_ROUNDING = 1e-6;

// How far a receiver is lifted off its plane, in texels: what a neighbouring triangle of a smooth mesh, turned by
// some ten degrees, stands out of this one's plane within the filter's reach of 1.5 texels.
const float CURVATURE_LIFT = 0.25;

// Share of the light that reaches a surface point, by 3 x 3 texels around it. normal is the triangle's own.
//
// A texel holds the depth of the nearest surface where the texel's own ray meets it, not where ours does; so each is
// compared with the receiver's plane where that same ray meets the plane. What the map stores, near / depth (or 1 -
// depth / range), is linear over the map on any plane, so the comparison is exact: a plane does not shadow itself
// however steep it stands, and shadows stay where they are. (Isidoro 2006, "Shadow Mapping: GPU-based Tips and
// Techniques", has the plane's depth as a derivative; here it comes from the plane itself.)
float light_visibility(vec3 position, vec3 normal) {
    float size = light.map.y;
    vec3 p = light_from_render(position);
    vec3 n = light_vector_from_render(normal);
    int face = 0;
    vec2 st;
    vec3 gradient;
#if MAP_KIND == MAP_ORTHOGRAPHIC
    vec2 half_sides = vec2(light.tangent.w, light.bitangent.w);
    p -= sign(n.z) * n * (2.0 * CURVATURE_LIFT * max(half_sides.x, half_sides.y) / size);
    st = p.xy / half_sides;
    // Seen from its edge a plane has no depth of its own there; 1e-4 is some hundredth of a degree.
    float along = abs(n.z) < 1e-4 ? 1e-4 : n.z;
    vec3 depth = vec3(-n.xy * half_sides, dot(n, p)) / along;
    gradient = vec3(0.0, 0.0, 1.0) - (depth - vec3(0.0, 0.0, POSITION_ROUNDING)) / light.map.z;
#else
    vec3 right;
    vec3 up;
    vec3 forward;
    float distance;
#if MAP_KIND == MAP_PERSPECTIVE
    if (p.z <= 0.0) {
        return 0.0;
    }
    right = vec3(light.axis.w, 0.0, 0.0);
    up = vec3(0.0, light.axis.w, 0.0);
    forward = vec3(0.0, 0.0, 1.0);
    distance = p.z;
    float side = light.axis.w;
#else
    cube_face(p, face, st, distance);
    forward = cube_direction(face, vec2(0.0));
    right = cube_direction(face, vec2(1.0, 0.0)) - forward;
    up = cube_direction(face, vec2(0.0, 1.0)) - forward;
    float side = 1.0;
#endif
    // Towards the light.
    float height = dot(n, p);
    p -= sign(height) * n * (2.0 * CURVATURE_LIFT * side * distance / size);
    distance = dot(p, forward);
    st = vec2(dot(p, right), dot(p, up)) / max(side * side * distance, 1e-30);
    height = dot(n, p);
    float least = 1e-4 * distance;
    height = abs(height) < least ? (height < 0.0 ? -least : least) : height;
    gradient = light.map.z / height * vec3(dot(n, right), dot(n, up), dot(n, forward));
    gradient.z += light.map.z * POSITION_ROUNDING / (distance * distance);
#endif
    vec2 at = (st * 0.5 + 0.5) * size;
    ivec2 middle = ivec2(floor(at));
    vec2 f = at - vec2(middle) - 0.5;
    // Two texels wide, moving with the receiver.
    vec2 weights[3] = vec2[3](0.25 - 0.5 * f, vec2(0.5), 0.25 + 0.5 * f);
    float lit = 0.0;
    for (int i = 0; i < 9; ++i) {
        ivec2 texel = clamp(middle + ivec2(i % 3 - 1, i / 3 - 1), ivec2(0), ivec2(int(size) - 1));
        vec2 center = (vec2(texel) + 0.5) * (2.0 / size) - 1.0;
        // Depth is a rounded float: a few of its steps. Nothing lies before the map's near plane.
        float reference = min(dot(gradient, vec3(center, 1.0)) * (1.0 + 4e-6), 1.0);
        float nearest = texelFetch(shadow_texture, ivec3(texel, face), 0).r;
        lit += reference >= nearest ? weights[i % 3].x * weights[i / 3].y : 0.0;
    }
    return lit;
}

#endif
