// SPDX-License-Identifier: Apache-2.0
//
// Gives each surface that was marked in the approximate visibility grid a place in the list, in the order of its voxel; one
// thread a row of voxels along x. COUNT: counts them first, for passes/vpl_scan.comp, whose running sums of rows say where
// each row's begin. (Floats count to 2^24 exactly; the list has room for fewer.)
#include "lib/avg.glsl"

layout(local_size_x = GROUP_1D) in;
layout(std430, binding = SSBO_ROW_SUMS) buffer RowBlock { float row_sums[]; };
#ifdef COUNT
layout(binding = IMG_AVG_CELLS, r32ui) readonly uniform uimage2DArray cells;
#else
layout(binding = IMG_AVG_CELLS, r32ui) uniform uimage2DArray cells;
#endif

void main() {
    int row = int(gl_GlobalInvocationID.x);
    if (row >= avg.size.y * avg.size.z) {
        return;
    }
    ivec2 yz = ivec2(row % avg.size.y, row / avg.size.y);
#ifdef COUNT
    int found = 0;
    for (int x = 0; x < avg.size.x; ++x) {
        found += bitCount(imageLoad(cells, ivec3(x, yz)).r & AVG_AXES);
    }
    row_sums[row] = float(found);
#else
    uint place = row == 0 ? 0u : uint(row_sums[row - 1]);
    for (int x = 0; x < avg.size.x; ++x) {
        uint axes = imageLoad(cells, ivec3(x, yz)).r;
        if (axes != 0u) {
            imageStore(cells, ivec3(x, yz), uvec4(place << 3 | axes));
            place += uint(bitCount(axes));
        }
    }
#endif
}
