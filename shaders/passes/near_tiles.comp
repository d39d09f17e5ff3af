// SPDX-License-Identifier: Apache-2.0
// Lists the tiles of the screen where a virtual point light is near enough for the near field; a thread a tile. A tile
// looks at all of the interleaved blocks that it belongs to: each of their pixels knows of another part of the lights.
#include "lib/frame.glsl"

layout(local_size_x = GROUP_1D) in;
layout(binding = IMG_IN, r16f) readonly uniform image2D reach_image;  // near radius of lights that are near, or 0
layout(location = 0) uniform int n;  // side of a block
layout(std430, binding = SSBO_PIXEL_LIST) writeonly buffer TileBlock {
    uvec2 tiles[];  // place (x, y in 16 bits each), near radius (float bits)
};
layout(std430, binding = SSBO_DISPATCH) buffer DispatchBlock {
    uvec4 dispatch;  // groups along x and y, 1, tiles
};

void main() {
    ivec2 count = (frame.size.xy + GROUP_2D - 1) / GROUP_2D;
    int index = int(gl_GlobalInvocationID.x);
    if (index >= count.x * count.y) {
        return;
    }
    ivec2 tile = ivec2(index % count.x, index / count.x);
    float radius = 0.0;
    int side = max(n, GROUP_2D);
    ivec2 first = tile * GROUP_2D / side * side;
    for (int i = 0; i < side * side; ++i) {
        ivec2 pixel = first + ivec2(i % side, i / side);
        radius = max(radius, imageLoad(reach_image, min(pixel, frame.size.xy - 1)).r);
    }
    if (radius > 0.0) {
        uint place = atomicAdd(dispatch.w, 1u);
        atomicMax(dispatch.x, min(place + 1u, uint(MOST_GROUPS)));
        atomicMax(dispatch.y, place / uint(MOST_GROUPS) + 1u);
        tiles[place] = uvec2(uint(tile.x) | uint(tile.y) << 16, floatBitsToUint(radius));
    }
}
