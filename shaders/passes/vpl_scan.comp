// SPDX-License-Identifier: Apache-2.0
//
// Turns row sums into running sums, in place, by one group: each thread sums a run of rows, the runs' sums are
// scanned in shared memory (Hillis and Steele 1986, "Data Parallel Algorithms"), and the runs are added up.
//
// EVEN: half of the weight is shared out evenly among the rows that have any. Rows of a further bounce are places on
// equal areas of surface; by flux alone nearly all lights would stand next to the ones before, and a dim part of the
// scene, which may be all that is seen, would be left to a few.
#include "shared/bindings.h"

layout(local_size_x = GROUP_SCAN) in;
layout(location = 0) uniform int rows;

layout(std430, binding = SSBO_ROW_SUMS) buffer RowBlock { float row_sums[]; };

shared vec2 runs[2][GROUP_SCAN];

// Sum over the threads before this one; the second value is that over all.
void scan(int me, vec2 sum, out vec2 before, out vec2 all) {
    int from = 0;
    runs[0][me] = sum;
    for (int reach = 1; reach < GROUP_SCAN; reach *= 2) {
        barrier();
        runs[1 - from][me] = runs[from][me] + (me >= reach ? runs[from][me - reach] : vec2(0.0));
        from = 1 - from;
    }
    barrier();
    before = me == 0 ? vec2(0.0) : runs[from][me - 1];
    all = runs[from][GROUP_SCAN - 1];
}

void main() {
    int me = int(gl_LocalInvocationID.x);
    int length = (rows + GROUP_SCAN - 1) / GROUP_SCAN;
    int first = min(me * length, rows);
    int last = min(first + length, rows);
    vec2 sum = vec2(0.0);  // of the rows, and how many have any weight
    for (int i = first; i < last; ++i) {
        sum += vec2(row_sums[i], row_sums[i] > 0.0 ? 1.0 : 0.0);
    }
    vec2 before;
    vec2 all;
    scan(me, sum, before, all);
#ifdef EVEN
    float even = 0.5 * all.x / max(all.y, 1.0);
    float running = 0.5 * before.x + even * before.y;
    for (int i = first; i < last; ++i) {
        running += row_sums[i] > 0.0 ? 0.5 * row_sums[i] + even : 0.0;
        row_sums[i] = running;
    }
#else
    float running = before.x;
    for (int i = first; i < last; ++i) {
        running += row_sums[i];
        row_sums[i] = running;
    }
#endif
}
