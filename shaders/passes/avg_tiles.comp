// SPDX-License-Identifier: Apache-2.0
//
// Large triangles into the approximate visibility grid: a group takes a triangle through a tile of columns, one thread
// each. Groups share out the list by their numbers.
#include "lib/avg_triangle.glsl"

layout(local_size_x = AVG_TILE, local_size_y = AVG_TILE) in;
layout(binding = IMG_AVG_TILES, r32ui) readonly uniform uimage2D tiles;
layout(binding = IMG_AVG_COUNTS, r32ui) readonly uniform uimage2D counts;

void main() {
    uint count = min(imageLoad(counts, ivec2(0)).r, uint(AVG_MOST_TILES));
    for (uint at = gl_WorkGroupID.x; at < count; at += uint(AVG_TILE_GROUPS)) {
        ivec2 texel = ivec2(2u * (at % uint(AVG_TILE_ROW)), at / uint(AVG_TILE_ROW));
        uint number = imageLoad(tiles, texel).r;
        uint tile = imageLoad(tiles, texel + ivec2(1, 0)).r;
        AvgTriangle t;
        if (number == 0xffffffffu || !load_triangle(number, t)) {
            continue;
        }
        ivec2 first;
        ivec2 last;
        triangle_columns(t, first, last);
        ivec2 column = ivec2(tile & 0xffffu, tile >> 16) * AVG_TILE + ivec2(gl_LocalInvocationID.xy);
        if (all(greaterThanEqual(column, first)) && all(lessThanEqual(column, last))) {
            meet_column(t, column);
        }
    }
}
