// SPDX-License-Identifier: Apache-2.0
//
// Parabolic maps of a hemisphere (Brabec, Annen and Seidel 2002, "Shadow Mapping for Hemispherical and
// Omnidirectional Light Sources"). A unit direction (x, y, z), z > 0 along the map's axis, lies at
// (x, y) / (1 + z) in the unit disk. The map is conformal: at (s, t) with r^2 = s^2 + t^2 lengths on the sphere
// are 2 / (1 + r^2) = 1 + z times those in the disk.
#ifndef LIB_PARABOLOID
#define LIB_PARABOLOID

// d need not be unit; length is its length.
vec2 paraboloid_project(vec3 d, float len) {
    return d.xy / (len + d.z);
}

vec3 paraboloid_direction(vec2 st) {
    float r2 = dot(st, st);
    return vec3(2.0 * st, 1.0 - r2) / (1.0 + r2);
}

// Solid angle of a small area of the disk.
float paraboloid_solid_angle(vec2 st, float area) {
    float scale = 2.0 / (1.0 + dot(st, st));
    return area * scale * scale;
}

#endif
