// SPDX-License-Identifier: Apache-2.0
//
// Draws large triangles into the imperfect shadow maps, exactly: a thread a texel, a group a tile of one map. Seen
// from the light, a ray lies inside a triangle where it lies on the inner side of the three planes through the
// light and an edge, so there is nothing to project or to clip.
#include "lib/ism.glsl"

layout(local_size_x = GROUP_MAP_TILE, local_size_y = GROUP_MAP_TILE) in;
layout(binding = IMG_OUT, r32ui) writeonly uniform uimage2D atlas_image;
layout(std430, binding = SSBO_TRIANGLES) readonly buffer TriangleBlock { vec4 triangles[]; };

struct Wedge {
    vec3 edges[3];        // normals of the planes through the light and an edge
    vec3 normal;          // of the triangle
    float inverse_plane;  // of normal . x on the triangle; 0 where it covers nothing
};
shared Wedge wedges[TRIANGLE_COUNT];

Wedge make_wedge(GpuVpl vpl, int triangle) {
    vec3 a = vpl_from_render(vpl, triangles[3 * triangle].xyz - vpl.position.xyz);
    vec3 b = vpl_from_render(vpl, triangles[3 * triangle + 1].xyz - vpl.position.xyz);
    vec3 c = vpl_from_render(vpl, triangles[3 * triangle + 2].xyz - vpl.position.xyz);
    Wedge w;
    vec3 across = cross(b - a, c - a);
    float len = length(across);
    w.normal = across / max(len, 1e-30);
    float plane = dot(w.normal, a);
    // Turned so that the triangle is seen from its front: then the inner side of each plane is the positive one.
    float side = plane < 0.0 ? -1.0 : 1.0;
    w.normal *= side;
    plane *= side;
    w.edges[0] = side * cross(a, b);
    w.edges[1] = side * cross(b, c);
    w.edges[2] = side * cross(c, a);
    // One in whose plane the light lies hides nothing but itself: a wall does not hide what is on it.
    w.inverse_plane = len > 0.0 && plane > LEAST_PLANE_DISTANCE ? 1.0 / plane : 0.0;
    return w;
}

// The coefficients c of c . (s, t, 1), positive to the left of the line from a to b.
vec3 left_of(vec2 a, vec2 b) {
    vec2 d = b - a;
    return vec3(-d.y, d.x, d.y * a.x - d.x * a.y);
}

// As make_wedge() for a light at infinity, with the ray's place in the map, (s, t, 1), for its direction: both the edges
// and the depth of the plane are linear in it. normal: coefficients of 1 minus the depth over the map's reach.
Wedge make_prism(GpuVpl vpl, int triangle) {
    float scale = 1.0 / distant_reach(vpl);
    vec3 a = vpl_from_render(vpl, triangles[3 * triangle].xyz - vpl.position.xyz) * scale;
    vec3 b = vpl_from_render(vpl, triangles[3 * triangle + 1].xyz - vpl.position.xyz) * scale;
    vec3 c = vpl_from_render(vpl, triangles[3 * triangle + 2].xyz - vpl.position.xyz) * scale;
    Wedge w;
    vec3 across = cross(b - a, c - a);
    float side = across.z < 0.0 ? -1.0 : 1.0;
    w.edges[0] = side * left_of(a.xy, b.xy);
    w.edges[1] = side * left_of(b.xy, c.xy);
    w.edges[2] = side * left_of(c.xy, a.xy);
    // On the scene's hull, where another surface goes on, no light may pass between the two: a texel that has any of the
    // triangle in it shows it (passes/triangle_seals.comp).
    float half_texel = 1.0 / float(ism.atlas.x);
    for (int i = 0; i < 3; ++i) {
        float sealed = max(abs(triangles[3 * triangle + i].w) - 1.0, 0.0);
        w.edges[i].z += sealed * half_texel * (abs(w.edges[i].x) + abs(w.edges[i].y));
    }
    bool seen = abs(across.z) > 1e-4 * length(across);
    across /= seen ? across.z : 1.0;
    w.normal = vec3(across.xy, 1.0 - dot(across, a));
    // Seen from its edge it hides nothing; nor does one on the hull that all of the scene lies before. Drawn beyond its
    // edge, that would take the place of the one it meets there.
    bool last = triangles[3 * triangle].w * side < -0.5;
    w.inverse_plane = seen && !last ? 1.0 : 0.0;
    return w;
}

// The triangle that a ray meets first.
struct Nearest {
    float closeness;  // 1 / distance; 0 where there is none
    vec3 normal;
};

void draw(Wedge w, vec3 ray, inout Nearest nearest) {
    float inside = min(min(dot(w.edges[0], ray), dot(w.edges[1], ray)), dot(w.edges[2], ray));
    float closeness = inside >= 0.0 ? dot(w.normal, ray) * w.inverse_plane : 0.0;
    bool nearer = closeness > nearest.closeness;
    nearest.closeness = nearer ? closeness : nearest.closeness;
    nearest.normal = nearer ? w.normal : nearest.normal;
}

void main() {
    int map = int(gl_WorkGroupID.z);
    int me = int(gl_LocalInvocationIndex);
    for (int i = me; i < TRIANGLE_COUNT; i += GROUP_MAP_TILE * GROUP_MAP_TILE) {
#ifdef DISTANT
        wedges[i] = make_prism(vpls[map], i);
#else
        wedges[i] = make_wedge(vpls[map], i);
#endif
    }
    barrier();
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    float texel_size = 2.0 / float(ism.atlas.x);
    vec3 window = map_window(vpls[map]);
    texel_size *= window.z;
    vec2 at = (vec2(texel) + 0.5) * texel_size - window.z + window.xy;
#ifdef DISTANT
    vec3 ray = vec3(at, 1.0);
#else
    vec3 ray = paraboloid_direction(at);
#endif
    ivec2 place = ism_origin(map) + texel;
    Nearest nearest = Nearest(0.0, vec3(0.0, 0.0, 1.0));
    // Written out, up to MOST_TRIANGLES, so that every index is a constant.
#define T(i) if (i < TRIANGLE_COUNT) draw(wedges[min(i, TRIANGLE_COUNT - 1)], ray, nearest);
#define T8(i) T(i) T(i + 1) T(i + 2) T(i + 3) T(i + 4) T(i + 5) T(i + 6) T(i + 7)
    T8(0) T8(8) T8(16) T8(24) T8(32) T8(40) T8(48) T8(56)
#ifdef DISTANT
    uint bits = pack_distant(1.0 - nearest.closeness, -nearest.normal.xy, float(ism.atlas.x));
#else
    float along = max(dot(nearest.normal, ray), 1e-6);
    uint bits = pack_ism(1.0 / max(nearest.closeness, 1e-30), plane_slope(nearest.normal, along, at, texel_size));
#endif
    imageStore(atlas_image, place, uvec4(nearest.closeness > 0.0 ? bits : ISM_EMPTY));
}
