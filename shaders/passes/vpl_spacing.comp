// SPDX-License-Identifier: Apache-2.0
//
// Surface area that each virtual point light of a further bounce stands for, from how densely they lie: the disk
// around a light that holds its NEIGHBOURS nearest ones that face alike, shared out among them. (The maps they were
// drawn from overlap, so a texel's own area says nothing about it.)
#include "lib/vpl.glsl"

layout(local_size_x = GROUP_1D) in;
layout(location = 0) uniform int stride;  // every stride-th light is looked at

layout(std430, binding = SSBO_VPLS_OUT) buffer VplOutBlock { GpuVpl spaced[]; };

const int NEIGHBOURS = 4;

void main() {
    int index = int(gl_GlobalInvocationID.x);
    if (index >= ism.atlas.z) {
        return;
    }
    int place = vpl_place(index);
    vec3 position = spaced[place].position.xyz;
    vec3 normal = spaced[place].normal.xyz;
    float nearest[NEIGHBOURS];
    for (int k = 0; k < NEIGHBOURS; ++k) {
        nearest[k] = 1.0;  // squared; the scene's own diagonal
    }
    for (int i = index % stride; i < ism.atlas.z; i += stride) {
        int other = vpl_place(i);
        vec3 d = spaced[other].position.xyz - position;
        float squared = i != index && dot(spaced[other].normal.xyz, normal) > 0.5 ? dot(d, d) : 1.0;
        for (int k = 0; k < NEIGHBOURS; ++k) {
            float less = min(nearest[k], squared);
            squared = max(nearest[k], squared);
            nearest[k] = less;
        }
    }
    spaced[place].position.w = 3.14159265 * nearest[NEIGHBOURS - 1] / float(NEIGHBOURS * stride);
}
