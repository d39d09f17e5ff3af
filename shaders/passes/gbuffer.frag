// SPDX-License-Identifier: Apache-2.0
#include "lib/gbuffer.glsl"
#include "lib/material.glsl"

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

void main() {
    // The triangle's own normal, before any discard, while the neighbours are still there.
    vec3 across = cross(dFdx(in_position), dFdy(in_position));
    vec3 emission;
    float alpha;
    Surface s = material_surface(emission, alpha);
    out_gbuffer0 = vec4(s.base_color, s.roughness);
    out_gbuffer1 = pack_gbuffer1(s);
    vec3 geometric = safe_normalize(across * 1e6, s.normal);  // derivatives are small: keep their square a float
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
