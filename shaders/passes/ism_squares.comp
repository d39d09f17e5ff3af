// SPDX-License-Identifier: Apache-2.0
//
// Imperfect shadow maps from squares of one depth, each of the solid angle of the area that its point stands for.
//
// SHARED: a group draws one map in shared memory; with LEVELS it fills the holes there. Otherwise a group draws a
// part of one map's points by atomics on the atlas, which was cleared before.
#include "lib/splat.glsl"

#define GROUP_SIZE GROUP_SPLAT
layout(local_size_x = GROUP_SPLAT) in;
layout(binding = IMG_OUT, r32ui) uniform uimage2D atlas_image;
layout(std430, binding = SSBO_POINTS) readonly buffer PointBlock { uvec4 points[]; };

#ifdef SHARED
shared uint nearest[MAP_SIZE * MAP_SIZE];
#ifdef LEVELS
layout(location = 0) uniform vec2 thresholds;  // pull, push
layout(binding = IMG_OUT1, r32ui) writeonly uniform uimage2D filled_image;
#define SIDE MAP_SIZE
#define FINE_BITS nearest  // a second array would not fit beside it
#include "lib/pull_push.glsl"
#endif
#endif

void draw_square(Splat s, ivec2 origin) {
    uint bits = pack_ism_flat(s.distance);
    // The texels whose centres the square covers, and at least the point's own.
    ivec2 own = ivec2(s.place);
    ivec2 low = clamp(min(ivec2(ceil(s.place - s.half_side - 0.5)), own), ivec2(0), ivec2(MAP_SIZE - 1));
    ivec2 high = clamp(max(ivec2(floor(s.place + s.half_side - 0.5)), own), ivec2(0), ivec2(MAP_SIZE - 1));
    ivec2 extent = high - low + 1;
    int count = extent.x * extent.y;
    for (int i = 0; i < count; ++i) {
        ivec2 texel = low + ivec2(i % extent.x, i / extent.x);
#ifdef SHARED
        atomicMin(nearest[texel.y * MAP_SIZE + texel.x], bits);
#else
        imageAtomicMin(atlas_image, origin + texel, bits);
#endif
    }
}

void main() {
    int map = int(gl_WorkGroupID.x);
    int me = int(gl_LocalInvocationID.x);
    ivec2 origin = ism_origin(map);
    GpuVpl vpl = vpls[map];
    Splat s;
#ifdef SHARED
    for (int i = me; i < MAP_SIZE * MAP_SIZE; i += GROUP_SPLAT) {
        nearest[i] = ISM_EMPTY;
    }
    barrier();
    for (int i = me; i < ism.atlas.w; i += GROUP_SPLAT) {
        if (see_point(vpl, points[point_place(map, i)], float(MAP_SIZE), s)) {
            draw_square(s, origin);
        }
    }
    barrier();
    for (int i = me; i < MAP_SIZE * MAP_SIZE; i += GROUP_SPLAT) {
        imageStore(atlas_image, origin + ivec2(i % MAP_SIZE, i / MAP_SIZE), uvec4(nearest[i]));
    }
#ifdef LEVELS
    for (int i = me; i < MAP_SIZE * MAP_SIZE; i += GROUP_SPLAT) {
        STORE_FINE(i, nearest[i] == ISM_EMPTY ? HOLE : unpackHalf2x16(nearest[i]).y);
    }
    pull_push(me, thresholds.x, thresholds.y);
    for (int i = me; i < MAP_SIZE * MAP_SIZE; i += GROUP_SPLAT) {
        float depth = LOAD_FINE(i);
        uint bits = depth < 0.0 ? ISM_EMPTY : pack_ism_flat(depth);
        imageStore(filled_image, origin + ivec2(i % MAP_SIZE, i / MAP_SIZE), uvec4(bits));
    }
#endif
#else
    int index = int(gl_GlobalInvocationID.y) * GROUP_SPLAT + me;
    if (index < ism.atlas.w && see_point(vpl, points[point_place(map, index)], float(MAP_SIZE), s)) {
        draw_square(s, origin);
    }
#endif
}
