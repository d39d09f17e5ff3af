// SPDX-License-Identifier: Apache-2.0
//
// The approximate visibility grid (Bashford-Rogers et al. 2012, "Approximate Visibility Grids for Interactive Indirect
// Illumination", III.A): cubic voxels around the scene, and what surfaces are in each.
//
// The paper keeps one summed normal and colour a voxel. Here a voxel has up to three surfaces, one for each axis that
// normals may point along most, so that a wall and the floor it stands on are two; and of each the sum of
// n n^T instead of n, in which the two sides of a thin wall do not cancel out (avg_normal()).
//
// Coordinates "in voxels" count from the grid's first corner; voxel i reaches from i to i + 1.
#ifndef LIB_AVG
#define LIB_AVG

#include "lib/math.glsl"
#include "shared/bindings.h"
#include "shared/types.h"

layout(std140, binding = UBO_AVG) uniform AvgBlock {
    AvgUniforms avg;
};

// A word of the grid's index (r32ui, a layer for each z): bits 0 to 2 say which axes have a surface here, the rest
// where the first of these stands in the list.
const uint AVG_AXES = 7u;

vec3 voxels_from_render(vec3 position) {
    return (position - avg.origin.xyz) / avg.origin.w;
}

vec3 render_from_voxels(vec3 at) {
    return avg.origin.xyz + at * avg.origin.w;
}

// Where the surface of an axis stands in the list. Those that found it full share its last place.
uint avg_surface_index(uint word, uint axis) {
    uint place = (word >> 3) + uint(bitCount(word & ((1u << axis) - 1u)));
    return min(place, uint(avg.size.w) - 1u);
}

vec3 avg_times_tensor(GpuAvgVoxel surface, vec3 v) {
    vec3 d = surface.tensor_diagonal.xyz;
    vec3 r = surface.tensor_rest.xyz;
    return vec3(dot(vec3(d.x, r.x, r.y), v), dot(vec3(r.x, d.y, r.z), v), dot(vec3(r.y, r.z, d.z), v));
}

// The mean normal that a ray along `direction` meets, turned against it. Of surfaces i with areas a and normals n, of
// which either side may be met, it meets each in proportion to a |n.d|, and the side -sign(n.d) n of it; so the mean is
// along -sum a (n.d) n = -(sum a n n^T) d. Without any, the direction back.
vec3 avg_normal(GpuAvgVoxel surface, vec3 direction) {
    return safe_normalize(-avg_times_tensor(surface, direction) / max(surface.tensor_diagonal.w, 1e-30), -direction);
}

#endif
