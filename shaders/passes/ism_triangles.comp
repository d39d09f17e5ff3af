// SPDX-License-Identifier: Apache-2.0
//
// Draws large triangles into the imperfect shadow maps, exactly: a thread a texel, a group a tile of one map. Seen
// from the light, a ray lies inside a triangle where it lies on the inner side of the three planes through the
// light and an edge, so there is nothing to project or to clip.
#include "lib/ism.glsl"

layout(local_size_x = GROUP_MAP_TILE, local_size_y = GROUP_MAP_TILE) in;
layout(location = 0) uniform int first;  // of TRIANGLE_COUNT triangles
layout(binding = IMG_OUT, r32ui) uniform uimage2D atlas_image;
layout(std430, binding = SSBO_TRIANGLES) readonly buffer TriangleBlock { vec4 triangles[]; };

struct Wedge {
    vec3 edges[3];  // normals of the planes through the light and an edge
    vec3 normal;    // of the triangle
    float plane;    // normal . x on the triangle; 0 where it covers nothing
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
    w.plane = dot(w.normal, a);
    // Turned so that the triangle is seen from its front: then the inner side of each plane is the positive one.
    float side = w.plane < 0.0 ? -1.0 : 1.0;
    w.normal *= side;
    w.plane *= side;
    w.edges[0] = side * cross(a, b);
    w.edges[1] = side * cross(b, c);
    w.edges[2] = side * cross(c, a);
    // One in whose plane the light lies hides nothing but itself: a wall does not hide what is on it.
    w.plane = len > 0.0 && w.plane > LEAST_PLANE_DISTANCE ? w.plane : 0.0;
    return w;
}

void draw(Wedge w, vec3 ray, vec2 at, float texel_size, inout uint nearest) {
    float along = dot(w.normal, ray);
    float inside = min(min(dot(w.edges[0], ray), dot(w.edges[1], ray)), dot(w.edges[2], ray));
    uint bits = pack_ism(w.plane / along, plane_slope(w.normal, along, at, texel_size));
    nearest = w.plane > 0.0 && inside >= 0.0 && along > 1e-6 ? min(nearest, bits) : nearest;
}

void main() {
    int map = int(gl_WorkGroupID.z);
    int me = int(gl_LocalInvocationIndex);
    for (int i = me; i < TRIANGLE_COUNT; i += GROUP_MAP_TILE * GROUP_MAP_TILE) {
        wedges[i] = make_wedge(vpls[map], first + i);
    }
    barrier();
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    float texel_size = 2.0 / float(ism.atlas.x);
    vec2 at = (vec2(texel) + 0.5) * texel_size - 1.0;
    vec3 ray = paraboloid_direction(at);
    ivec2 place = ism_origin(map) + texel;
    uint nearest = ISM_EMPTY;
#ifdef NEXT_TRIANGLES
    nearest = imageLoad(atlas_image, place).r;
#endif
    // Written out, so that every index is a constant.
#define T(i) if (i < TRIANGLE_COUNT) draw(wedges[min(i, TRIANGLE_COUNT - 1)], ray, at, texel_size, nearest);
    T(0) T(1) T(2) T(3) T(4) T(5) T(6) T(7) T(8) T(9) T(10) T(11) T(12) T(13) T(14) T(15)
    imageStore(atlas_image, place, uvec4(nearest));
}
