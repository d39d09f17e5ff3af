// SPDX-License-Identifier: Apache-2.0
// Running sums of importance along each row of a reflective map, and the rows' totals; a group a row, each thread a
// run of texels. FROM_IRSM: of imperfect maps.
#ifdef FROM_IRSM
#include "lib/irsm.glsl"
#elif defined(SPHERE)
#include "lib/sphere.glsl"
#else
#define READ_RSM
#include "lib/vpl_importance.glsl"
#endif

layout(local_size_x = GROUP_ROW) in;
layout(location = 0) uniform ivec3 first;  // this source's first row among those of all, its first texel, its rows

layout(std430, binding = SSBO_ROW_SUMS) writeonly buffer RowBlock { float row_sums[]; };
layout(std430, binding = SSBO_TEXEL_SUMS) writeonly buffer TexelBlock { float texel_sums[]; };

shared float runs[2][GROUP_ROW];

void main() {
    int row = int(gl_WorkGroupID.y) * MOST_GROUPS + int(gl_WorkGroupID.x);
    if (row >= first.z) {
        return;  // the group as a whole
    }
    int me = int(gl_LocalInvocationID.x);
    int size = source_size();
    int length = (size + GROUP_ROW - 1) / GROUP_ROW;
    int begin = min(me * length, size);
    int end = min(begin + length, size);
    float sum = 0.0;
    for (int x = begin; x < end; ++x) {
        sum += texel_importance(ivec2(x, row % source_rows()), row / source_rows());
    }
    int from = 0;
    runs[0][me] = sum;
    for (int reach = 1; reach < GROUP_ROW; reach *= 2) {
        barrier();
        runs[1 - from][me] = runs[from][me] + (me >= reach ? runs[from][me - reach] : 0.0);
        from = 1 - from;
    }
    barrier();
    float before = me == 0 ? 0.0 : runs[from][me - 1];
    for (int x = begin; x < end; ++x) {
        before += texel_importance(ivec2(x, row % source_rows()), row / source_rows());
        texel_sums[first.y + row * size + x] = before;
    }
    if (me == GROUP_ROW - 1) {
        row_sums[first.x + row] = before;
    }
}
