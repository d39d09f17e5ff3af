// SPDX-License-Identifier: Apache-2.0
//
// Gives each surface that was marked in the approximate visibility grid a place in the list, with sums of zero. Places
// depend on the order of threads; what is summed there and traced does not.
#include "lib/avg.glsl"

layout(local_size_x = GROUP_1D) in;
layout(binding = IMG_AVG_CELLS, r32ui) uniform uimage2DArray cells;
layout(binding = IMG_AVG_COUNTS, r32ui) uniform uimage2D counts;
layout(std430, binding = SSBO_AVG_SUMS) buffer SumBlock { uint sums[]; };

void main() {
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (cell.x >= avg.size.x) {
        return;
    }
    uint axes = imageLoad(cells, cell).r;
    if (axes == 0u) {
        return;
    }
    uint wanted = uint(bitCount(axes));
    uint first = imageAtomicAdd(counts, ivec2(1, 0), wanted);
    imageStore(cells, cell, uvec4(first << 3 | axes));
    for (uint i = first; i < min(first + wanted, uint(avg.size.w)); ++i) {
        for (uint word = 0u; word < uint(AVG_SUM_WORDS); ++word) {
            sums[i * uint(AVG_SUM_WORDS) + word] = 0u;
        }
    }
}
