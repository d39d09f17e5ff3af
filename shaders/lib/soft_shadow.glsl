// SPDX-License-Identifier: Apache-2.0
//
// What a receiver sees of a light with a size: maps from places on it, each compared as a hard shadow's map is
// (lib/shadow.glsl). SOFT_KIND is the maps' kind; MAP_KIND stays that of the light's own.
#ifndef LIB_SOFT_SHADOW
#define LIB_SOFT_SHADOW

#include "lib/light_place.glsl"
#include "lib/shadow.glsl"

layout(std140, binding = UBO_SHADOW_VIEWS) uniform ShadowViewBlock {
    ShadowViews shadow_views;
};

// As plane_lit(), over the four texels around the place, weighed by how near they are: a map's own outline has no steps.
// slack is within a pixel's and a texel's reach.
float plane_lit_smooth(MapPlane plane, vec2 at, float slack, float size) {
    vec2 corner = floor(at - 0.5);
    vec2 part = clamp(at - 0.5 - corner, 0.0, 1.0);
    vec2 step_ = plane.gradient.xy * (2.0 / size);
    float here = dot(plane.gradient, vec3((corner + 0.5) * (2.0 / size) - 1.0, 1.0));
    // In the order of textureGather.
    vec4 reference = here + vec4(step_.y, step_.x + step_.y, step_.x, 0.0);
    reference = clamp(reference * (1.0 + 4e-6) + plane.nearer * (slack + POSITION_ROUNDING), 0.0, 1.0);
    vec4 depth = textureGather(shadow_texture, vec3((corner + 1.0) / size, float(plane.face)));
    vec4 lit = vec4(greaterThanEqual(reference, depth));
    vec2 rows = mix(lit.wx, lit.zy, part.x);
    return mix(rows.x, rows.y, part.y);
}

// Shares of the light: x what arrives, y what would without a shadow.
vec2 view_share(GpuShadowView view, int index, SoftReceiver r) {
#if SOFT_KIND == MAP_ORTHOGRAPHIC
    vec3 to_light = -normalize(view.forward.xyz);
    const float squared = 1.0;
#else
    vec3 to_light = view.origin.xyz - r.position;
    float squared = max(dot(to_light, to_light), 1e-30);
    to_light *= inversesqrt(squared);
#endif
    float weight = place_weight(r.normal, to_light, squared);
    vec2 pixel = vec2(view.to_s.w, view.to_t.w);
    vec3 p = r.position + r.right * pixel.x + r.up * pixel.y - view.origin.xyz;
    float size = view.forward.w;
    MapPlane plane;
#if SOFT_KIND == MAP_CUBE
    vec3 in_light = light_vector_from_render(p);
    int face;
    float depth;
    cube_face(in_light, face, plane.st, depth);
    plane.face = index * 6 + face;
    vec3 middle = cube_direction(face, vec2(0.0));
    vec3 forward = render_from_light_vector(middle);
    vec3 right = render_from_light_vector(cube_direction(face, vec2(1.0, 0.0)) - middle);
    vec3 up = render_from_light_vector(cube_direction(face, vec2(0.0, 1.0)) - middle);
#else
    vec3 forward = view.forward.xyz;
    vec3 right = view.right.xyz;
    vec3 up = view.up.xyz;
    float depth = dot(p, view.to_depth.xyz);
    plane.st = vec2(dot(p, view.to_s.xyz), dot(p, view.to_t.xyz));
    plane.face = index;
#endif
    vec3 along = vec3(dot(r.plane, right), dot(r.plane, up), dot(r.plane, forward));
    float texel = 2.0 * sqrt(max(dot(right, right), dot(up, up))) / size;
    float height = dot(r.plane, p);
#if SOFT_KIND == MAP_ORTHOGRAPHIC
    height += (along.z < 0.0 ? 1.0 : -1.0) * CURVATURE_LIFT * texel;
    float slant = abs(along.z) < 1e-4 ? 1e-4 : along.z;
    plane.gradient = vec3(0.0, 0.0, 1.0) - vec3(-along.xy, height) / (slant * view.origin.w);
    plane.nearer = 1.0 / view.origin.w;
#else
    depth = max(depth, 1e-30);
#if SOFT_KIND == MAP_PERSPECTIVE
    plane.st /= depth;
#endif
    texel *= depth;
    // Not past the light, which may stand nearer to the plane than that.
    height += (height < 0.0 ? 1.0 : -1.0) * min(CURVATURE_LIFT * texel, 0.5 * abs(height));
    float least = 1e-4 * depth;
    height = abs(height) < least ? (height < 0.0 ? -least : least) : height;
    plane.gradient = view.origin.w / height * along;
    plane.nearer = view.origin.w / (depth * depth);
#endif
    vec2 at = (plane.st * 0.5 + 0.5) * size;
    float slack = r.slack * length(pixel) + CONTACT_SLOPE * texel;
    return weight * vec2(plane_lit_smooth(plane, at, slack, size), 1.0);
}

#endif
