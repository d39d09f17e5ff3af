// SPDX-License-Identifier: Apache-2.0
//
// A batch's triangles into the approximate visibility grid, one thread each. Those that may meet many columns of voxels
// are put on a list, tile by tile, for passes/avg_tiles.comp.
#include "lib/avg_triangle.glsl"

layout(local_size_x = GROUP_1D) in;
layout(binding = IMG_AVG_TILES, r32ui) writeonly uniform uimage2D tiles;
layout(binding = IMG_AVG_COUNTS, r32ui) uniform uimage2D counts;  // tiles on the list

void main() {
    uint number = (gl_WorkGroupID.y * uint(MOST_GROUPS) + gl_WorkGroupID.x) * uint(GROUP_1D) + gl_LocalInvocationID.x;
    if (number >= batch.y * draws_in_batch) {
        return;
    }
    AvgTriangle t;
    if (!load_triangle(number, t)) {
        return;
    }
    ivec2 first;
    ivec2 last;
    triangle_columns(t, first, last);
    ivec2 columns = last - first + 1;
    if (columns.x * columns.y > AVG_SMALL) {
        ivec2 first_tile = first / AVG_TILE;
        ivec2 across = last / AVG_TILE - first_tile + 1;
        uint wanted = uint(across.x * across.y);
        uint place = imageAtomicAdd(counts, ivec2(0), wanted);
        if (place + wanted <= uint(AVG_MOST_TILES)) {
            for (uint i = 0u; i < wanted; ++i) {
                ivec2 tile = first_tile + ivec2(int(i) % across.x, int(i) / across.x);
                uint at = place + i;
                ivec2 texel = ivec2(2u * (at % uint(AVG_TILE_ROW)), at / uint(AVG_TILE_ROW));
                imageStore(tiles, texel, uvec4(number));
                imageStore(tiles, texel + ivec2(1, 0), uvec4(uint(tile.x) | uint(tile.y) << 16));
            }
            return;
        }
        // The list is full. What it would have held of this triangle counts as none.
        for (uint at = place; at < min(place + wanted, uint(AVG_MOST_TILES)); ++at) {
            imageStore(tiles, ivec2(2u * (at % uint(AVG_TILE_ROW)), at / uint(AVG_TILE_ROW)), uvec4(0xffffffffu));
        }
    }
    ivec2 depths = ivec2(floor(clamp(vec2(min(min(t.corner[0].z, t.corner[1].z), t.corner[2].z) - AVG_REACH,
                                          max(max(t.corner[0].z, t.corner[1].z), t.corner[2].z) + AVG_REACH),
                                     0.0, turned(vec3(avg.size.xyz), t.axis).z - 0.5)));
    meet_box(t, ivec3(first, depths.x), ivec3(last, depths.y));
}
