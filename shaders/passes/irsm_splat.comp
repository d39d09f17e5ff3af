// SPDX-License-Identifier: Apache-2.0
// Splats points of all surfaces, as oriented disks, into imperfect reflective shadow maps; a group draws one map in
// shared memory. Which point a texel shows is kept, and with it all that the point knows.
#define REFLECTORS
#include "lib/splat.glsl"

layout(local_size_x = GROUP_SPLAT) in;
layout(binding = IMG_OUT, r32ui) writeonly uniform uimage2D irsm_image;
layout(std430, binding = SSBO_POINTS) readonly buffer PointBlock { uvec4 points[]; };

shared uint nearest[MAP_SIZE * MAP_SIZE];

void main() {
    const float texel_size = 2.0 / float(MAP_SIZE);
    int map = int(gl_WorkGroupID.x);
    int me = int(gl_LocalInvocationID.x);
    GpuVpl vpl = vpls[map];
    for (int i = me; i < MAP_SIZE * MAP_SIZE; i += GROUP_SPLAT) {
        nearest[i] = 0xffffffffu;
    }
    barrier();
    for (int i = me; i < ism.atlas.w; i += GROUP_SPLAT) {
        Splat s;
        if (!see_point(vpl, points[point_place(map, i)], float(MAP_SIZE), s)) {
            continue;
        }
        float plane = dot(s.normal, s.center);
        // Around a near disk the map is not flat; one that the light lies beside may fill it.
        bool beside = dot(s.center, s.center) < 4.0 * s.radius2;
        ivec2 low = beside ? ivec2(0) : max(ivec2(floor(s.place - s.reach)), ivec2(0));
        ivec2 high = beside ? ivec2(MAP_SIZE - 1) : min(ivec2(floor(s.place + s.reach)), ivec2(MAP_SIZE - 1));
        ivec2 extent = max(high - low + 1, ivec2(0));  // both may be negative where the disk lies off the map
        int count = extent.x * extent.y;
        for (int k = 0; k < count; ++k) {
            ivec2 texel = low + ivec2(k % max(extent.x, 1), k / max(extent.x, 1));
            vec3 ray = paraboloid_direction((vec2(texel) + 0.5) * texel_size - 1.0);
            float t = plane / dot(s.normal, ray);
            vec3 off = ray * t - s.center;
            if (t > 0.0 && dot(off, off) <= s.radius2) {
                atomicMin(nearest[texel.y * MAP_SIZE + texel.x], packHalf2x16(vec2(0.0, t)) | uint(i));
            }
        }
    }
    barrier();
    ivec2 origin = ism_origin(map);
    for (int i = me; i < MAP_SIZE * MAP_SIZE; i += GROUP_SPLAT) {
        imageStore(irsm_image, origin + ivec2(i % MAP_SIZE, i / MAP_SIZE), uvec4(nearest[i]));
    }
}
