// SPDX-License-Identifier: Apache-2.0
//
// Lists the tiles of the picture that have a penumbra; a thread a tile.
#include "lib/frame.glsl"

layout(local_size_x = GROUP_1D) in;
layout(std430, binding = SSBO_TILE_FLAGS) readonly buffer FlagBlock {
    uint flags[];
};
layout(std430, binding = SSBO_PIXEL_LIST) writeonly buffer TileBlock {
    uint tiles[];  // place, x and y in 16 bits each
};
layout(std430, binding = SSBO_DISPATCH) buffer DispatchBlock {
    uvec4 dispatch;  // groups along x and y, 1, tiles
};

void main() {
    ivec2 count = (frame.size.xy + GROUP_2D - 1) / GROUP_2D;
    int index = int(gl_GlobalInvocationID.x);
    if (index < count.x * count.y && flags[index] == 3u) {
        uint place = atomicAdd(dispatch.w, 1u);
        atomicMax(dispatch.x, min(place + 1u, uint(MOST_GROUPS)));
        atomicMax(dispatch.y, place / uint(MOST_GROUPS) + 1u);
        tiles[place] = uint(index % count.x) | uint(index / count.x) << 16;
    }
}
