// SPDX-License-Identifier: Apache-2.0
//
// Finds the edges of large triangles on the scene's hull along which another of them goes on: there light from outside
// cannot come in, and shadow maps of the world draw the triangle half a texel beyond its edge (passes/ism_triangles.comp).
// Behind such an edge there is nothing that it could hide by mistake: all of the scene lies on one side of either plane.
// Writes 2 to w of such an edge's first corner and 1 to that of others, negative where the scene lies on the side that
// the triangle is seen clockwise from; other triangles have 0. Runs rarely; a thread a triangle.
#include "shared/bindings.h"

layout(local_size_x = GROUP_1D) in;
layout(location = 0) uniform ivec2 hull;  // the first triangle on the hull, their number

layout(std430, binding = SSBO_TRIANGLES) buffer TriangleBlock { vec4 triangles[]; };

// Surfaces that meet do so up to this, render units (the scene's diagonal is 1): what counts as on the hull may stand
// off by as much (scene/points/hull.cpp).
const float TOLERANCE = 1e-3;

vec3 corner(int triangle, int i) {
    return triangles[3 * triangle + i % 3].xyz;
}

// Whether a place lies in a triangle, up to the tolerance.
bool covers(int triangle, vec3 p) {
    vec3 normal = cross(corner(triangle, 1) - corner(triangle, 0), corner(triangle, 2) - corner(triangle, 0));
    float size = length(normal);
    normal /= max(size, 1e-30);
    bool inside = size > 0.0 && abs(dot(normal, p - corner(triangle, 0))) < TOLERANCE;
    for (int i = 0; i < 3; ++i) {
        vec3 along = corner(triangle, i + 1) - corner(triangle, i);
        vec3 inwards = cross(normal, along / max(length(along), 1e-30));
        inside = inside && dot(inwards, p - corner(triangle, i)) > -TOLERANCE;
    }
    return inside;
}

void main() {
    int me = int(gl_GlobalInvocationID.x);
    if (me >= hull.y) {
        return;
    }
    // The mean of corners on the hull is within it.
    vec3 middle = vec3(0.0);
    for (int i = 0; i < hull.y; ++i) {
        middle += (corner(hull.x + i, 0) + corner(hull.x + i, 1) + corner(hull.x + i, 2)) / float(3 * hull.y);
    }
    vec3 a = corner(hull.x + me, 0);
    vec3 across = cross(corner(hull.x + me, 1) - a, corner(hull.x + me, 2) - a);
    float side = dot(across, middle - a) < 0.0 ? -1.0 : 1.0;
    for (int edge = 0; edge < 3; ++edge) {
        bool sealed = true;
        for (int i = 0; i < 4; ++i) {
            vec3 place = mix(corner(hull.x + me, edge), corner(hull.x + me, edge + 1), (float(i) + 0.5) / 4.0);
            bool covered = false;
            for (int other = 0; other < hull.y; ++other) {
                covered = covered || (other != me && covers(hull.x + other, place));
            }
            sealed = sealed && covered;
        }
        triangles[3 * (hull.x + me) + edge].w = side * (sealed ? 2.0 : 1.0);
    }
}
