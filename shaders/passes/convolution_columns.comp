// SPDX-License-Identifier: Apache-2.0
//
// The second half of a summed-area table: running sums down the columns of what convolution_rows.comp left. A thread a
// column and layer, neighbouring threads neighbouring columns.
#include "shared/bindings.h"

layout(local_size_x = GROUP_1D) in;
layout(location = 0) uniform ivec2 job;  // first layer, map size
layout(binding = IMG_OUT, rgba32f) uniform image2DArray sums;

void main() {
    int x = int(gl_GlobalInvocationID.x);
    if (x > job.y) {
        return;
    }
    int layer = job.x + int(gl_WorkGroupID.y);
    imageStore(sums, ivec3(x, 0, layer), vec4(0.0));
    vec4 sum = vec4(0.0);
    for (int y = 1; y <= job.y; ++y) {
        sum += imageLoad(sums, ivec3(x, y, layer));
        imageStore(sums, ivec3(x, y, layer), sum);
    }
}
