// SPDX-License-Identifier: Apache-2.0
//
// Running sums of the basis along each row of a layer of a light's map: the first half of a summed-area table (Crow 1984,
// "Summed-Area Tables for Texture Mapping"). A group a row and basis layer, each thread a run of texels. Texel (x, y) of
// the table belongs to the corner between texels, so that it has one more a side than the map.
#include "lib/convolution.glsl"

layout(local_size_x = GROUP_ROW) in;
layout(location = 0) uniform ivec2 job;  // layer, map size
layout(binding = TEX_SHADOW) uniform sampler2DArray shadow_texture;
layout(std140, binding = UBO_SHADOW_VIEWS) uniform ShadowViewBlock {
    ShadowViews shadow_views;
};
layout(std430, binding = SSBO_DEPTH_RANGE) readonly buffer RangeBlock {
    uvec2 range_bits;
};
layout(binding = IMG_OUT, rgba32f) writeonly uniform image2DArray sums;

shared vec4 runs[2][GROUP_ROW];

vec4 value(int x, int y, int layer, vec2 range) {
    float stored = texelFetch(shadow_texture, ivec3(x, y, job.x), 0).r;
    // Where there is no surface nothing is nearer than any receiver.
    float depth = stored > 0.0 ? unit_depth(linear_depth(stored, shadow_views.view[0]), range) : MOST_DEPTH;
    return basis(layer, depth);
}

void main() {
    int y = int(gl_WorkGroupID.x);
    int layer = int(gl_WorkGroupID.y);
    int me = int(gl_LocalInvocationID.x);
    vec2 range = uintBitsToFloat(range_bits);
    int length = (job.y + GROUP_ROW - 1) / GROUP_ROW;
    int begin = min(me * length, job.y);
    int end = min(begin + length, job.y);
    vec4 sum = vec4(0.0);
    for (int x = begin; x < end; ++x) {
        sum += value(x, y, layer, range);
    }
    int from = 0;
    runs[0][me] = sum;
    for (int reach = 1; reach < GROUP_ROW; reach *= 2) {
        barrier();
        runs[1 - from][me] = runs[from][me] + (me >= reach ? runs[from][me - reach] : vec4(0.0));
        from = 1 - from;
    }
    barrier();
    vec4 before = me == 0 ? vec4(0.0) : runs[from][me - 1];
    int out_layer = job.x * BASIS_LAYERS + layer;
    if (me == 0) {
        imageStore(sums, ivec3(0, y + 1, out_layer), vec4(0.0));
    }
    for (int x = begin; x < end; ++x) {
        before += value(x, y, layer, range);
        imageStore(sums, ivec3(x + 1, y + 1, out_layer), before);
    }
}
