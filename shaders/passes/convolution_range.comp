// SPDX-License-Identifier: Apache-2.0
//
// Nearest and farthest surface in one layer of a light's map. Distances are positive, so their bits are ordered as they are.
#include "lib/convolution.glsl"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(location = 0) uniform ivec2 job;  // layer, map size
layout(binding = TEX_SHADOW) uniform sampler2DArray shadow_texture;
layout(std140, binding = UBO_SHADOW_VIEWS) uniform ShadowViewBlock {
    ShadowViews shadow_views;
};
layout(std430, binding = SSBO_DEPTH_RANGE) buffer RangeBlock {
    uvec2 range_bits;
};

shared uint nearest;
shared uint farthest;

void main() {
    if (gl_LocalInvocationIndex == 0u) {
        nearest = 0xffffffffu;
        farthest = 0u;
    }
    barrier();
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(texel, ivec2(job.y)))) {
        float stored = texelFetch(shadow_texture, ivec3(texel, job.x), 0).r;
        if (stored > 0.0) {  // there is a surface
            uint bits = floatBitsToUint(max(linear_depth(stored, shadow_views.view[0]), 0.0));
            atomicMin(nearest, bits);
            atomicMax(farthest, bits);
        }
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u && nearest <= farthest) {
        atomicMin(range_bits.x, nearest);
        atomicMax(range_bits.y, farthest);
    }
}
