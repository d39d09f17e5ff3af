// SPDX-License-Identifier: Apache-2.0
//
// Rays through the approximate visibility grid.
//
// The paper ends a ray in the first voxel that holds a surface, other than the one it starts in (WHOLE_VOXELS). Rays that
// leave a floor at a low angle then end in the next voxel of the same floor. Here a voxel's surface is known to lie
// within two slabs (lib/avg.glsl), one for what faces either way, and a ray ends where it enters one, or goes on. No
// surface is passed by, because none is outside of its slab; a flat one is met where it is, however it stands in its
// voxel; and the place lies on the ray's side of the surface.
#ifndef LIB_AVG_TRACE
#define LIB_AVG_TRACE

#include "lib/avg.glsl"

layout(binding = IMG_AVG_CELLS, r32ui) readonly uniform uimage2DArray cells;
layout(std430, binding = SSBO_AVG_VOXELS) readonly buffer VoxelBlock { GpuAvgVoxel surfaces[]; };

struct AvgHit {
    vec3 position;  // render space
    vec3 normal;    // unit, against the ray
    vec3 color;
    vec4 surface;   // as GpuAvgVoxel::surface
};

// A ray leaves its own surface by so much of a voxel, eight times what slabs are widened by (AVG_REACH in
// lib/avg_triangle.glsl).
const float AVG_LEAVE = 8.0 / 4096.0;

// Of a surface that a ray starts on: a slab up to this thick, in voxels, whose normal is within 45 degrees of its own.
const float AVG_OWN_SLAB = 0.5;
const float AVG_OWN_COSINE = 0.7071;

// A number in 0 to 1 from another and a voxel; decides at surfaces with holes.
float avg_chance(float number, ivec3 cell) {
    uint x = uint(cell.x) + uint(cell.y) * 0x9E3779B9u + uint(cell.z) * 0x85EBCA6Bu + uint(number * 16777216.0);
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return (float(x >> 8) + 0.5) / 16777216.0;
}

// The surfaces of a voxel taken together, in proportion to their areas.
void add_surface(GpuAvgVoxel s, inout GpuAvgVoxel sum) {
    float area = s.tensor_diagonal.w;
    sum.tensor_diagonal += s.tensor_diagonal;
    sum.tensor_rest.xyz += s.tensor_rest.xyz;
    sum.tensor_rest.w += s.tensor_rest.w * area;
    sum.color += s.color * area;
    sum.surface += s.surface * area;
}

// Follows a ray from a place in render space. leaving: unit, across the surface it starts on, or 0 where it starts in the
// open. numbers: of a low-discrepancy sequence; x how far into a voxel, y at surfaces with holes. False where it leaves
// the grid.
bool trace_avg(vec3 origin, vec3 direction, vec3 leaving, vec2 numbers, out AvgHit hit) {
    vec3 start = voxels_from_render(origin) + leaving * AVG_LEAVE;
    vec3 size = vec3(avg.size.xyz);
    // Axes along which the ray does not move are never crossed.
    vec3 inverse = 1.0 / mix(direction, vec3(1e-20), lessThan(abs(direction), vec3(1e-20)));
    vec3 to_low = -start * inverse;
    vec3 to_high = (size - start) * inverse;
    vec3 enters = min(to_low, to_high);
    vec3 leaves = max(to_low, to_high);
    float t = max(max(max(enters.x, enters.y), enters.z), 0.0);
    float end = min(min(leaves.x, leaves.y), leaves.z);
    hit.position = vec3(0.0);
    hit.normal = -direction;
    hit.color = vec3(0.0);
    hit.surface = vec4(0.0);
    if (!(t < end)) {
        return false;
    }
    ivec3 cell = clamp(ivec3(floor(start + direction * t)), ivec3(0), avg.size.xyz - 1);
    ivec3 step_ = ivec3(sign(inverse));
    // Where the ray crosses the next plane of each axis.
    vec3 next = (vec3(cell) + max(vec3(step_), 0.0) - start) * inverse;
    vec3 stride = abs(inverse);
    bool first = t == 0.0;
    // Where the ray passed the holes of a surface last, of each axis, facing up and down: one that lies between two voxels
    // is in both.
    vec2 passed[3] = vec2[3](vec2(-1.0), vec2(-1.0), vec2(-1.0));
    int most = avg.size.x + avg.size.y + avg.size.z;
    for (int i = 0; i < most; ++i) {
        float until = min(min(next.x, next.y), next.z);
        uint word = imageLoad(cells, cell).r;
        if ((word & AVG_AXES) != 0u) {
            float chance = avg_chance(numbers.y, cell);
#ifdef WHOLE_VOXELS
            GpuAvgVoxel sum;
            sum.tensor_diagonal = sum.tensor_rest = sum.normal = sum.color = sum.surface = vec4(0.0);
            sum.slab = ivec4(0);
            for (uint axis = 0u; axis < 3u; ++axis) {
                if ((word >> axis & 1u) == 1u) {
                    add_surface(surfaces[avg_surface_index(word, axis)], sum);
                }
            }
            float area = max(sum.tensor_diagonal.w, 1e-30);
            if (!first && chance < sum.tensor_rest.w / area) {
                hit.position = render_from_voxels(start + direction * mix(t, until, numbers.x));
                hit.normal = avg_normal(sum, direction);
                hit.color = sum.color.rgb / area;
                hit.surface = sum.surface / area;
                return true;
            }
#else
            float nearest = 1e30;
            uint found = 0u;
            for (uint axis = 0u; axis < 3u; ++axis) {
                if ((word >> axis & 1u) == 0u) {
                    continue;
                }
                uint index = avg_surface_index(word, axis);
                vec3 n = surfaces[index].normal.xyz;
                vec4 slabs = vec4(surfaces[index].slab) / AVG_SLAB_STEPS;
                float coverage = surfaces[index].tensor_rest.w;
                // Places along the normal at the begin of the ray's way through the voxel, and how they change.
                float along = dot(n, start + direction * t - (vec3(cell) + 0.5));
                float slope = dot(n, direction);
                // Where it starts within both, it is not known which of them is its own.
                bool within_both = along >= slabs.x && along <= slabs.y && along >= slabs.z && along <= slabs.w;
                for (int side = 0; side < 2; ++side) {
                    vec2 slab = side == 0 ? slabs.xy : slabs.zw;
                    float into = along > slab.y ? slab.y - along : along < slab.x ? slab.x - along : 0.0;
                    float enter = into == 0.0 ? t : into * slope > 0.0 ? t + into / slope : 1e30;
                    bool own = first && into == 0.0 &&
                               (leaving == vec3(0.0) || (slab.y - slab.x < AVG_OWN_SLAB && !within_both &&
                                                         abs(dot(n, leaving)) > AVG_OWN_COSINE));
                    bool met = slab.x <= slab.y && enter <= until + AVG_LEAVE && !own &&
                               abs(enter - passed[axis][side]) > AVG_LEAVE;
                    bool hole = met && chance >= coverage;
                    if (hole) {
                        passed[axis][side] = enter;
                    }
                    if (met && !hole && enter < nearest) {
                        nearest = enter;
                        found = index;
                    }
                }
            }
            if (nearest < 1e30) {
                GpuAvgVoxel s = surfaces[found];
                hit.position = render_from_voxels(start + direction * nearest);
                hit.normal = avg_normal(s, direction);
                hit.color = s.color.rgb;
                hit.surface = s.surface;
                return true;
            }
#endif
        }
        if (until >= end) {
            return false;
        }
        // The nearest plane, of one axis alone.
        bvec3 over = bvec3(next.x <= next.y && next.x <= next.z, next.y < next.x && next.y <= next.z,
                           next.z < next.x && next.z < next.y);
        cell += ivec3(over) * step_;
        next += vec3(over) * stride;
        t = until;
        first = false;
        if (any(lessThan(cell, ivec3(0))) || any(greaterThanEqual(cell, avg.size.xyz))) {
            return false;
        }
    }
    return false;
}

#endif
