// SPDX-License-Identifier: Apache-2.0
//
// Adds what one chunk of a light's maps shows of it, in the tiles that have a penumbra; a group a tile.
#define READ_GBUFFER
#include "lib/gbuffer.glsl"
#include "lib/soft_receiver.glsl"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(location = 1) uniform int first;  // map of the chunk
layout(std430, binding = SSBO_PIXEL_LIST) readonly buffer TileBlock {
    uint tiles[];
};
layout(std430, binding = SSBO_DISPATCH) readonly buffer DispatchBlock {
    uvec4 dispatch;
};
// Light that arrives, and that would without a shadow; of a light with an image (TINTED) the first in each channel.
#ifdef TINTED
layout(location = 2) uniform vec3 tints[SHADOW_VIEW_CHUNK];
layout(binding = IMG_OUT, rgba32f) uniform image2D share_image;
#define SHARES vec4
#define SHARED(share, i) vec4((share).x * tints[i], (share).y)
#else
layout(binding = IMG_OUT, rg32f) uniform image2D share_image;
#define SHARES vec2
#define SHARED(share, i) (share)
#endif

#ifdef IMPERFECT
// As in passes/vpl_gather.comp: outside of branches constant places in shared memory are scalar loads on every driver.
shared GpuVpl places[SHADOW_VIEW_CHUNK];
#endif

void main() {
#ifdef IMPERFECT
    if (gl_LocalInvocationIndex < uint(SHADOW_VIEW_CHUNK)) {
        places[gl_LocalInvocationIndex] = vpls[first + int(gl_LocalInvocationIndex)];
    }
    barrier();
#endif
    uint group = gl_WorkGroupID.y * uint(MOST_GROUPS) + gl_WorkGroupID.x;
    if (group >= dispatch.w) {
        return;
    }
    uint tile = tiles[group];
    ivec2 pixel = ivec2(tile & 0xffffu, tile >> 16) * GROUP_2D + ivec2(gl_LocalInvocationID.xy);
    SoftReceiver r;
    soft_receiver(min(pixel, frame.size.xy - 1), r);
    SHARES sum = SHARES(0.0);
#ifdef IMPERFECT
#define VIEW(i) { vec2 share = place_share(places[i], r); sum += SHARED(share, i); }
#else
#define VIEW(i) { vec2 share = view_share(shadow_views.view[i], first + i, r); sum += SHARED(share, i); }
#endif
    VIEW(0) VIEW(1) VIEW(2) VIEW(3) VIEW(4) VIEW(5) VIEW(6) VIEW(7)
    if (all(lessThan(pixel, frame.size.xy))) {
#ifndef FIRST_CHUNK
        sum += SHARES(imageLoad(share_image, pixel));
#endif
#ifdef TINTED
        imageStore(share_image, pixel, sum);
#else
        imageStore(share_image, pixel, vec4(sum, 0.0, 0.0));
#endif
    }
}
