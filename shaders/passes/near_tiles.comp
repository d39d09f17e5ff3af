// SPDX-License-Identifier: Apache-2.0
// Lists the tiles of the screen where a virtual point light is near enough for the near field; a thread a tile.
#include "lib/frame.glsl"

layout(local_size_x = GROUP_1D) in;
layout(binding = IMG_IN, r16f) readonly uniform image2D reach_image;  // near radius of lights that are near, or 0
layout(std430, binding = SSBO_PIXEL_LIST) writeonly buffer TileBlock {
    uvec2 tiles[];  // place (x, y in 16 bits each), near radius (float bits)
};
layout(std430, binding = SSBO_DISPATCH) buffer DispatchBlock {
    uvec4 dispatch;  // tiles, 1, 1, -
};

void main() {
    ivec2 count = (frame.size.xy + GROUP_2D - 1) / GROUP_2D;
    int index = int(gl_GlobalInvocationID.x);
    if (index >= count.x * count.y) {
        return;
    }
    ivec2 tile = ivec2(index % count.x, index / count.x);
    float radius = 0.0;
    for (int i = 0; i < GROUP_2D * GROUP_2D; ++i) {
        ivec2 pixel = tile * GROUP_2D + ivec2(i % GROUP_2D, i / GROUP_2D);
        radius = max(radius, imageLoad(reach_image, min(pixel, frame.size.xy - 1)).r);
    }
    if (radius > 0.0) {
        tiles[atomicAdd(dispatch.x, 1u)] = uvec2(uint(tile.x) | uint(tile.y) << 16, floatBitsToUint(radius));
    }
}
