// SPDX-License-Identifier: Apache-2.0
//
// Imperfect shadow maps from oriented disks. Every texel whose ray meets a point's disk gets the distance of that hit
// and the slope of its plane, so that neighbouring disks of one surface join without steps.
//
// SHARED: a group draws one map in shared memory. Otherwise a group draws a part of one map's points by atomics on
// the atlas, which was cleared before.
#include "lib/splat.glsl"

layout(local_size_x = GROUP_SPLAT) in;
layout(binding = IMG_OUT, r32ui) uniform uimage2D atlas_image;
layout(std430, binding = SSBO_POINTS) readonly buffer PointBlock { uvec4 points[]; };

#ifdef SHARED
shared uint nearest[MAP_SIZE * MAP_SIZE];
#define LOAD_CLOSE(texel) nearest[(texel).y * MAP_SIZE + (texel).x]
#include "lib/ism_close.glsl"
#endif

void draw_nearest(ivec2 origin, ivec2 texel, uint bits) {
#ifdef SHARED
    atomicMin(nearest[texel.y * MAP_SIZE + texel.x], bits);
#else
    imageAtomicMin(atlas_image, origin + texel, bits);
#endif
}

// What the disk's plane has at `at` of the map's disk (distant: -1 to 1 of the map); false where the disk does not reach there.
bool disk_texel(Splat s, float plane, float set_back, vec2 at, out uint bits) {
#ifdef DISTANT
    float steep = 1.0 / (abs(s.normal.z) > 1e-4 ? s.normal.z : 1e-4);
    vec2 slope = -s.normal.xy * steep;
    vec3 hit = vec3(at, 0.0);
    hit.z = plane * steep + dot(slope, hit.xy);
    vec3 off = hit - s.center;
    bits = pack_distant(hit.z + set_back / max(abs(s.normal.z), 0.1), slope, float(MAP_SIZE));
    return dot(off, off) <= s.radius2;
#else
    vec3 ray = paraboloid_direction(at);
    float along = dot(s.normal, ray);
    float t = plane / along;
    vec3 off = ray * t - s.center;
    // Along the ray a step back behind the plane is longer the more it slants; but a disk seen from its edge says
    // little about where its surface is.
    bits = pack_ism(t + set_back / max(abs(along), 0.1),
                    plane_slope(s.normal, along, at, 2.0 / float(MAP_SIZE) * s.window.z));
    return t > 0.0 && dot(off, off) <= s.radius2;
#endif
}

void draw_disk(Splat s, ivec2 origin) {
    const float texel_size = 2.0 / float(MAP_SIZE);
    float plane = dot(s.normal, s.center);
    float set_back = s.flat_surface ? 0.0 : ism.splat.y * sqrt(s.radius2);
    ivec2 low = max(ivec2(floor(s.place - s.reach)), ivec2(0));
    ivec2 high = min(ivec2(floor(s.place + s.reach)), ivec2(MAP_SIZE - 1));
    ivec2 extent = max(high - low + 1, ivec2(0));  // both may be negative where the disk lies off the map
    int count = extent.x * extent.y;
    for (int i = 0; i < count; ++i) {
        ivec2 texel = low + ivec2(i % max(extent.x, 1), i / max(extent.x, 1));
        vec2 at = ((vec2(texel) + 0.5) * texel_size - 1.0) * s.window.z + s.window.xy;
        uint bits;
        if (disk_texel(s, plane, set_back, at, bits)) {
            draw_nearest(origin, texel, bits);
        }
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
#ifdef OVER_TRIANGLES
        nearest[i] = imageLoad(atlas_image, origin + ivec2(i % MAP_SIZE, i / MAP_SIZE)).r;
#else
        nearest[i] = ISM_EMPTY;
#endif
    }
    barrier();
    for (int i = me; i < ism.atlas.w; i += GROUP_SPLAT) {
        if (see_point(vpl, points[point_place(map, i)], float(MAP_SIZE), s)) {
            draw_disk(s, origin);
        }
    }
    barrier();
    for (int i = me; i < MAP_SIZE * MAP_SIZE; i += GROUP_SPLAT) {
        ivec2 texel = ivec2(i % MAP_SIZE, i / MAP_SIZE);
#ifdef CLOSE
        imageStore(atlas_image, origin + texel, uvec4(closed_texel(texel)));
#else
        imageStore(atlas_image, origin + texel, uvec4(nearest[i]));
#endif
    }
#else
    int index = int(gl_GlobalInvocationID.y) * GROUP_SPLAT + me;
    if (index < ism.atlas.w && see_point(vpl, points[point_place(map, index)], float(MAP_SIZE), s)) {
        draw_disk(s, origin);
    }
#endif
}
