// SPDX-License-Identifier: Apache-2.0
#ifndef LIB_SHADOW
#define LIB_SHADOW

#include "lib/light.glsl"
#include "lib/pixel_filter.glsl"

layout(binding = TEX_SHADOW) uniform sampler2DArray shadow_texture;

// Rounding of positions in render space, whose unit is the scene's diagonal: a few steps of a float at 1. Each
// comparison gives a receiver this much, so that a surface does not shadow itself by rounding alone.
const float POSITION_ROUNDING = 1e-6;

// What may stand out of a receiver's plane without shadowing it: a neighbouring triangle of a smooth mesh, turned by some
// ten degrees, does so by this part of a texel in the texels next to the receiver's own,
const float CURVATURE_LIFT = 0.25;
// and farther off in the picture, within its filter's reach, the wall that a floor meets rises no faster than this slope.
// What is lost of a contact shadow by it is less than a pixel wide.
const float CONTACT_SLOPE = 1.0;

// The filter's reach across the picture, pixels, and its least reach in the map, texels: where texels are larger than
// pixels, their steps are smoothed.
const float PIXEL_REACH = 0.75;
const float LEAST_TEXEL_REACH = 1.0;

// A receiver's plane as a light's map sees it.
struct MapPlane {
    vec3 gradient;  // what the map would hold of the plane at (s, t): dot(gradient, (s, t, 1))
    vec2 st;        // of the receiver
    float nearer;   // what a unit of distance towards the light adds to that
    int face;
};

// Map coordinates of a place near a receiver, on the receiver's face.
vec2 map_place(vec3 p, int face) {
#if MAP_KIND == MAP_ORTHOGRAPHIC
    return p.xy / vec2(light.tangent.w, light.bitangent.w);
#elif MAP_KIND == MAP_PERSPECTIVE
    return p.xy / max(p.z * light.axis.w, 1e-30);
#else
    vec3 forward = cube_direction(face, vec2(0.0));
    vec3 right = cube_direction(face, vec2(1.0, 0.0)) - forward;
    vec3 up = cube_direction(face, vec2(0.0, 1.0)) - forward;
    return vec2(dot(p, right), dot(p, up)) / max(dot(p, forward), 1e-30);
#endif
}

// What the map stores, near / depth (or 1 - depth / range), is linear over the map on any plane. p and n: the receiver
// and its normal in the light's frame; lift: how far it is moved towards the light, render units.
MapPlane map_plane(vec3 p, vec3 n, int face, float lift) {
    MapPlane plane;
    plane.face = face;
#if MAP_KIND == MAP_ORTHOGRAPHIC
    p -= sign(n.z) * n * lift;
    // Seen from its edge a plane has no depth of its own; 1e-4 is some hundredth of a degree.
    float along = abs(n.z) < 1e-4 ? 1e-4 : n.z;
    vec3 depth = vec3(-n.xy * vec2(light.tangent.w, light.bitangent.w), dot(n, p)) / along;
    plane.gradient = vec3(0.0, 0.0, 1.0) - depth / light.map.z;
    plane.nearer = 1.0 / light.map.z;
#else
#if MAP_KIND == MAP_PERSPECTIVE
    vec3 right = vec3(light.axis.w, 0.0, 0.0);
    vec3 up = vec3(0.0, light.axis.w, 0.0);
    vec3 forward = vec3(0.0, 0.0, 1.0);
#else
    vec3 forward = cube_direction(face, vec2(0.0));
    vec3 right = cube_direction(face, vec2(1.0, 0.0)) - forward;
    vec3 up = cube_direction(face, vec2(0.0, 1.0)) - forward;
#endif
    float height = dot(n, p);
    // Not past the light, which may stand nearer to the plane than that.
    lift = min(lift, 0.5 * abs(height));
    p -= (height < 0.0 ? -lift : lift) * n;
    float distance = max(dot(p, forward), 1e-30);
    height = dot(n, p);
    float least = 1e-4 * distance;
    height = abs(height) < least ? (height < 0.0 ? -least : least) : height;
    plane.gradient = light.map.z / height * vec3(dot(n, right), dot(n, up), dot(n, forward));
    plane.nearer = light.map.z / (distance * distance);
#endif
    plane.st = map_place(p, face);
    return plane;
}

// 1 where nothing in the map is nearer than the plane by more than `slack`, render units; at: in texels.
float plane_lit(MapPlane plane, vec2 at, float slack, float size) {
    ivec2 texel = ivec2(clamp(at, vec2(0.0), vec2(size - 1.0)));
    vec2 center = (vec2(texel) + 0.5) * (2.0 / size) - 1.0;
    // Depth is a rounded float: a few of its steps. Nothing lies before the map's near plane.
    float reference = dot(plane.gradient, vec3(center, 1.0)) * (1.0 + 4e-6) + plane.nearer * (slack + POSITION_ROUNDING);
    // A ray that misses the plane, beyond its horizon, may go on for ever; only what it meets hides the light.
    reference = clamp(reference, 0.0, 1.0);
    return reference >= texelFetch(shadow_texture, ivec3(texel, plane.face), 0).r ? 1.0 : 0.0;
}

// Share of the light that reaches what a pixel shows of a surface. normal is the triangle's own; right and up: steps on
// its plane from one pixel to the next, render space.
//
// A texel holds the depth of the nearest surface where the texel's own ray meets it, not where ours does; so each is
// compared with the receiver's plane where that same ray meets the plane. The comparison is exact: a plane does not
// shadow itself however steep it stands, and shadows stay where they are. (Isidoro 2006, "Shadow Mapping: GPU-based
// Tips and Techniques", has the plane's depth from derivatives; here it comes from the plane.) The outline of a shadow
// is averaged by the picture's own pixel filter: four by four samples, weighed as in lib/pixel_filter.glsl. Five of
// them tell whether there is an outline at all.
float light_visibility(vec3 position, vec3 normal, vec3 right, vec3 up) {
    float size = light.map.y;
    vec3 p = light_from_render(position);
    vec3 n = light_vector_from_render(normal);
    int face = 0;
#if MAP_KIND == MAP_ORTHOGRAPHIC
    float texel = 2.0 * max(light.tangent.w, light.bitangent.w) / size;
#elif MAP_KIND == MAP_PERSPECTIVE
    if (p.z <= 0.0) {
        return 0.0;
    }
    float texel = 2.0 * light.axis.w * p.z / size;
#else
    vec2 st;
    float distance;
    cube_face(p, face, st, distance);
    float texel = 2.0 * distance / size;
#endif
    vec2 middle = map_place(p, face);
    vec2 step_right = (map_place(p + light_vector_from_render(right), face) - middle) * (0.5 * size);
    vec2 step_up = (map_place(p + light_vector_from_render(up), face) - middle) * (0.5 * size);
    vec2 reach = PIXEL_REACH * (abs(step_right) + abs(step_up));
    vec2 wanting = max(LEAST_TEXEL_REACH - reach, 0.0);
    MapPlane plane = map_plane(p, n, face, CURVATURE_LIFT * texel);
    vec2 at = (plane.st * 0.5 + 0.5) * size;
    vec2 step_s = vec2(wanting.x / PIXEL_REACH, 0.0) + step_right;
    vec2 step_t = vec2(0.0, wanting.y / PIXEL_REACH) + step_up;
    float slack = CONTACT_SLOPE * max(length(right), length(up));
    float probes = plane_lit(plane, at, 0.0, size);
    for (int i = 0; i < 4; ++i) {
        vec2 q = (vec2(i & 1, i >> 1) * 2.0 - 1.0) * PIXEL_REACH;
        probes += plane_lit(plane, at + q.x * step_s + q.y * step_t, slack * length(q), size);
    }
    if (probes == 0.0 || probes == 5.0) {
        return probes * 0.2;
    }
    float lit = 0.0;
    for (int i = 0; i < 16; ++i) {
        // Columns and rows are sheared by an eighth of a pixel, so that an outline along either crosses the samples one
        // by one.
        vec2 q = vec2(i & 3, i >> 2) * 0.5 - PIXEL_REACH;
        vec2 weight = mix(vec2(FILTER_NEAR), vec2(FILTER_FAR), greaterThan(abs(q), vec2(0.5)));
        q += (vec2(i >> 2, i & 3) - 1.5) * 0.125;
        lit += weight.x * weight.y * plane_lit(plane, at + q.x * step_s + q.y * step_t, slack * length(q), size);
    }
    return lit;
}

#endif
