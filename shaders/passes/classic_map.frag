// SPDX-License-Identifier: Apache-2.0
// The plane of the triangle that is seen: unit normal and distance from the eye along it, render units.
#include "lib/ism.glsl"
#include "lib/material.glsl"
#include "lib/view.glsl"

layout(location = 0) out vec4 out_plane;
layout(location = 7) in vec3 in_position;
#ifdef SET_BACK
layout(location = 11) flat in float in_set_back;
#else
const float in_set_back = 0.0;
#endif

void main() {
    // Before any discard, while the neighbours are still there.
    vec3 across = cross(dFdx(in_position), dFdy(in_position));
    vec3 emission;
    Surface s = material_surface(emission);  // cuts the holes
    vec3 normal = safe_normalize(across * 1e6, s.normal);
    float distance = dot(normal, in_position - view.eye.xyz);
    // A plane that the light lies in is the surface it stands on, which does not hide what is on it.
    if (abs(distance) < max(LEAST_PLANE_DISTANCE, in_set_back)) {
        discard;
    }
#ifdef SET_BACK
    distance += distance < 0.0 ? -in_set_back : in_set_back;
#endif
    out_plane = vec4(normal, distance);
}
