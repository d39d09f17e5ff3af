// SPDX-License-Identifier: Apache-2.0
#include "lib/gbuffer.glsl"
#include "lib/material.glsl"
#ifdef VALID_REFLECTIONS
#include "lib/frame.glsl"
#endif

layout(location = 0) out vec4 out_gbuffer0;
layout(location = 1) out vec4 out_gbuffer1;
#ifdef WRITE_ALPHA
layout(location = 2) out vec4 out_geometric_normal;  // z: alpha
#else
layout(location = 2) out vec2 out_geometric_normal;
#endif
#ifdef WRITE_EMISSION
layout(location = 3) out vec4 out_emission;
#endif
layout(location = 7) in vec3 in_position;

#ifdef VALID_REFLECTIONS
// The normal of a map, turned back towards the triangle's (both unit, on the viewer's side) as far as is needed for the
// mirrored view to leave the surface, as Cycles does. In the plane of both, with the angle a from the triangle's normal
// and the view's part (x, z) in it, the mirrored view stands out by x sin 2a + z cos 2a.
vec3 valid_reflection(vec3 geometric, vec3 v, vec3 normal) {
    float z = dot(geometric, v);
    float cosine = dot(geometric, normal);
    vec3 across = normal - geometric * cosine;
    float sine = length(across);
    if (sine < 1e-4 || z <= 0.0) {
        return normal;
    }
    across /= sine;
    float x = dot(across, v);
    // Cycles wants the mirrored view to stand out by this.
    float least = min(0.9 * z, 0.01);
    float limit = 0.5 * (atan(x, z) + acos(clamp(least * inversesqrt(x * x + z * z), -1.0, 1.0)));
    float angle = atan(sine, cosine);
    return angle <= limit ? normal : normalize(geometric * cos(limit) + across * sin(limit));
}
#endif

void main() {
    // The triangle's own normal, before any discard, while the neighbours are still there.
    vec3 across = cross(dFdx(in_position), dFdy(in_position));
    vec3 emission;
    float alpha;
    Surface s = material_surface(emission, alpha);
    vec3 geometric = safe_normalize(across * 1e6, s.normal);  // derivatives are small: keep their square a float
#ifdef VALID_REFLECTIONS
    vec3 v = direction_to_viewer(in_position);
    s.normal = valid_reflection(dot(geometric, v) < 0.0 ? -geometric : geometric, v, s.normal);
#endif
    out_gbuffer0 = vec4(s.base_color, s.roughness);
    out_gbuffer1 = pack_gbuffer1(s);
    geometric = dot(geometric, s.normal) < 0.0 ? -geometric : geometric;
#ifdef WRITE_ALPHA
    out_geometric_normal = vec4(octahedral_encode(geometric) * 0.5 + 0.5, alpha, 0.0);
#else
    out_geometric_normal = octahedral_encode(geometric) * 0.5 + 0.5;
#endif
#ifdef WRITE_EMISSION
    out_emission = vec4(emission, 1.0);
#endif
}
