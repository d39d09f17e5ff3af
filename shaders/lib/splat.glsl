// SPDX-License-Identifier: Apache-2.0
//
// A point seen from a virtual point light.
#ifndef LIB_SPLAT
#define LIB_SPLAT

#include "lib/ism.glsl"
#include "lib/points.glsl"

struct Splat {
    vec3 center;    // in the frame of the light's map
    vec3 normal;    // the same
    float distance;
    float radius2;  // squared, of the disk that the point stands for
    vec2 place;     // in the map, in texels
    float reach;    // of the disk as seen face on, in texels
    float half_side;  // of a square of the disk's solid angle, in texels
    vec3 window;      // map_window()
    bool flat_surface;
};

// False where nothing is to be drawn: the point's surface is hidden; it lies behind the light's tangent plane, where
// the light sends nothing; or the light lies inside the disk's own sphere, so that the point is no place of its own
// but part of the surface the light stands on.
bool see_surface_point(GpuVpl vpl, SurfacePoint p, float map_size, out Splat s) {
    s.radius2 = p.radius * p.radius * ism.splat.x;
    s.center = vpl_from_render(vpl, p.position - vpl.position.xyz);
    s.normal = vpl_from_render(vpl, p.normal);
    s.flat_surface = p.flat_surface;
    s.window = map_window(vpl);
#ifdef DISTANT
    // In units of the map's reach.
    float scale = 1.0 / distant_reach(vpl);
    s.center *= scale;
    s.radius2 *= scale * scale;
    s.distance = s.center.z;
    s.place = (s.center.xy * 0.5 + 0.5) * map_size;
    s.reach = sqrt(s.radius2) * (0.5 * map_size);
    s.half_side = s.reach * sqrt(0.25 * PI * abs(s.normal.z));
    return s.radius2 > 0.0 && s.center.z < 1.0;
#else
    float distance2 = dot(s.center, s.center);
    s.distance = sqrt(distance2);
    s.place = ((paraboloid_project(s.center, s.distance) - s.window.xy) / s.window.z * 0.5 + 0.5) * map_size;
    // Lengths on the unit sphere are 1 + z times those in the map.
    s.reach = sqrt(s.radius2) / max(s.distance + s.center.z, 1e-20) * (0.5 * map_size) / s.window.z;
    float cosine = abs(dot(s.normal, s.center)) / max(s.distance, 1e-20);
    s.half_side = s.reach * sqrt(0.25 * PI * cosine);
#ifdef REFLECTORS
    // A disk may well be near; only one in whose plane the light lies is the surface that the light stands on.
    bool apart = abs(dot(s.normal, s.center)) > LEAST_PLANE_DISTANCE;
#else
    bool apart = distance2 > s.radius2;
#endif
#ifdef WINDOW
    apart = apart && all(greaterThan(s.place + s.reach, vec2(0.0))) && all(lessThan(s.place - s.reach, vec2(map_size)));
#endif
#ifdef BOTH_SIDES
    // The other hemisphere has a map of its own; a disk across the border is in both.
    return s.center.z > -min(sqrt(s.radius2), 0.5 * s.distance) && s.radius2 > 0.0 && apart;
#else
    return s.center.z > 0.0 && s.radius2 > 0.0 && apart;
#endif
#endif
}

bool see_point(GpuVpl vpl, uvec4 bits, float map_size, out Splat s) {
    return see_surface_point(vpl, unpack_point(bits), map_size, s);
}

// A map's index-th point: each map takes a block of the sequence, points.w maps further on.
int point_place(int map, int index) {
    map = (map + ism.points.w) % ism.atlas.z;
    return ism.points.y + (map * ism.atlas.w % ism.points.x + index) % ism.points.x;
}

#endif
