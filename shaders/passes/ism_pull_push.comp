// SPDX-License-Identifier: Apache-2.0
//
// Pull-push over an atlas that was drawn by atomics or, FROM_DEPTH, by the depth test; a group a tile of a map. Tiles
// of maps that do not fit into shared memory as a whole overlap by BORDER.
#include "lib/ism.glsl"

#define GROUP_SIZE GROUP_SPLAT
layout(local_size_x = GROUP_SPLAT) in;
layout(location = 0) uniform vec2 thresholds;  // pull, push
layout(binding = IMG_OUT, r32ui) writeonly uniform uimage2D filled_image;
#ifdef FROM_DEPTH
layout(binding = TEX_DEPTH) uniform sampler2D depth_texture;
#else
layout(binding = IMG_IN, r32ui) readonly uniform uimage2D atlas_image;
#endif
#include "lib/pull_push.glsl"

// Distance in the atlas, or HOLE.
float load(ivec2 place) {
#ifdef FROM_DEPTH
    float depth = texelFetch(depth_texture, place, 0).r;
    return depth > 0.0 ? 1.0 / depth - 1.0 : HOLE;
#else
    uint bits = imageLoad(atlas_image, place).r;
    return bits == ISM_EMPTY ? HOLE : unpackHalf2x16(bits).y;
#endif
}

void main() {
    const int core = SIDE - 2 * BORDER;
    int me = int(gl_LocalInvocationID.x);
    ivec2 origin = ism_origin(int(gl_WorkGroupID.z));
    ivec2 begin = ivec2(gl_WorkGroupID.xy) * core - BORDER;
    ivec2 last = ivec2(ism.atlas.x - 1);
    for (int i = me; i < SIDE * SIDE; i += GROUP_SIZE) {
        fine[i] = load(origin + clamp(begin + ivec2(i % SIDE, i / SIDE), ivec2(0), last));
    }
    pull_push(me, thresholds.x, thresholds.y);
    for (int i = me; i < SIDE * SIDE; i += GROUP_SIZE) {
        ivec2 local = ivec2(i % SIDE, i / SIDE);
        ivec2 texel = begin + local;
        bool mine = all(greaterThanEqual(local, ivec2(BORDER))) && all(lessThan(local, ivec2(SIDE - BORDER))) &&
                    all(lessThanEqual(texel, last));
        if (mine) {
            uint bits = fine[i] < 0.0 ? ISM_EMPTY : pack_ism_flat(fine[i]);
            imageStore(filled_image, origin + texel, uvec4(bits));
        }
    }
}
