// SPDX-License-Identifier: Apache-2.0
// Fills the holes of one map of SIDE x SIDE depths, the x of each input, by one group of 64: an item of the harness is
// a 64th of the map.
#define GROUP_SIZE 64
layout(local_size_x = GROUP_SIZE) in;
layout(std430, binding = 0) readonly buffer InputBlock { vec4 inputs[]; };
layout(std430, binding = 1) writeonly buffer OutputBlock { vec4 outputs[]; };
layout(location = 0) uniform uint item_count;
#include "lib/pull_push.glsl"

void main() {
    int me = int(gl_LocalInvocationIndex);
    for (int i = me; i < SIDE * SIDE; i += GROUP_SIZE) {
        fine[i] = inputs[i].x;
    }
    pull_push(me, PULL, PUSH);
    for (int i = me; i < SIDE * SIDE && item_count > 0u; i += GROUP_SIZE) {
        outputs[i] = vec4(fine[i], 0.0, 0.0, 0.0);
    }
}
