// SPDX-License-Identifier: Apache-2.0
// The plane of the triangle that is seen: unit normal and distance from the eye along it, render units.
#include "lib/ism.glsl"
#include "lib/material.glsl"
#include "lib/view.glsl"

layout(location = 0) out vec4 out_plane;
layout(location = 7) in vec3 in_position;

void main() {
    // Before any discard, while the neighbours are still there.
    vec3 across = cross(dFdx(in_position), dFdy(in_position));
    vec3 emission;
    Surface s = material_surface(emission);  // cuts the holes
    vec3 normal = safe_normalize(across * 1e6, s.normal);
    float distance = dot(normal, in_position - view.eye.xyz);
    // A plane that the light lies in is the surface it stands on, which does not hide what is on it.
    if (abs(distance) < LEAST_PLANE_DISTANCE) {
        discard;
    }
    out_plane = vec4(normal, distance);
}
