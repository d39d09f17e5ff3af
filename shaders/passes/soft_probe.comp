// SPDX-License-Identifier: Apache-2.0
//
// Finds the tiles of the picture where a light's shadow has a penumbra: of neighbouring pixels each asks another chunk
// of the light's maps, so that a tile asks all of them several times over. A dispatch takes the pixels of one chunk.
#define READ_GBUFFER
#include "lib/gbuffer.glsl"
#include "lib/soft_receiver.glsl"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(location = 0) uniform ivec4 job;  // block's width and height, this dispatch's place in it
layout(location = 1) uniform int first;  // map of the chunk
layout(std430, binding = SSBO_TILE_FLAGS) buffer FlagBlock {
    uint flags[];  // a tile; 1: some map sees the light, 2: some does not
};

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
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) * job.xy + job.zw;
    bool inside = all(lessThan(pixel, frame.size.xy));
    SoftReceiver r;
    float depth = soft_receiver(min(pixel, frame.size.xy - 1), r);
    vec2 sum = vec2(0.0);
#ifdef IMPERFECT
#define VIEW(i) sum += place_share(places[i], r);
#else
#define VIEW(i) sum += view_share(shadow_views.view[i], first + i, r);
#endif
    VIEW(0) VIEW(1) VIEW(2) VIEW(3) VIEW(4) VIEW(5) VIEW(6) VIEW(7)
    if (inside && depth > 0.0 && sum.y > 0.0) {
        ivec2 tile = pixel / GROUP_2D;
        int tiles_x = (frame.size.x + GROUP_2D - 1) / GROUP_2D;
#ifdef TINTED
        // What is seen of the light tells its colour there, even where all of it is seen.
        uint seen = sum.x > 0.0 ? 3u : 2u;
#else
        uint seen = (sum.x > 0.0 ? 1u : 0u) | (sum.x < sum.y ? 2u : 0u);
#endif
        atomicOr(flags[tile.y * tiles_x + tile.x], seen);
    }
}
