// SPDX-License-Identifier: Apache-2.0
// A texel of a light's parabolic map (lib/ism.glsl), drawn by the map's own projection: where the texel's ray meets the
// plane of the triangle that covers it.
#include "lib/ism.glsl"
#include "lib/material.glsl"
#include "lib/view.glsl"

layout(location = 0) out uint out_bits;
layout(location = 7) in vec3 in_position;
#ifdef SET_BACK
layout(location = 11) flat in float in_set_back;
#else
const float in_set_back = 0.0;
#endif

void main() {
    // Before any discard, while the neighbours are still there. Positions are linear in the map, as it is drawn, so their
    // differences lie in the triangle's plane.
    vec3 across = cross(dFdx(in_position), dFdy(in_position));
    vec3 emission;
    Surface s = material_surface(emission);  // cuts the holes
    vec3 normal = safe_normalize(across * 1e6, s.normal);
    float distance = dot(normal, in_position - view.eye.xyz);
    float texel_size = 2.0 / float(ism.atlas.x);
    vec2 at = gl_FragCoord.xy * texel_size - 1.0;
    vec3 local = paraboloid_direction(at);
    mat3 map_from_render = mat3(view.clip_from_render);
    float along = dot(normal, transpose(map_from_render) * local);
    // As in passes/classic_map.frag; and the map's corners lie below the horizon.
    if (abs(distance) < max(LEAST_PLANE_DISTANCE, in_set_back) || local.z < 0.0) {
        discard;
    }
    distance += distance < 0.0 ? -in_set_back : in_set_back;
    float hit = distance / along;
    // The bent triangle covers a texel whose ray misses its plane.
    if (!(hit > 0.0)) {
        discard;
    }
    out_bits = pack_ism(hit, plane_slope(map_from_render * normal, along, at, texel_size));
    gl_FragDepth = 1.0 / (1.0 + hit);
}
