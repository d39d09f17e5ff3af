// SPDX-License-Identifier: Apache-2.0
// An atlas of shadow maps, or one map, fitted into the picture.
#include "lib/frame.glsl"
#include "lib/ism.glsl"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(location = 0) uniform int only;  // this map alone; -1: all
layout(binding = IMG_OUT, rgba32f) writeonly uniform image2D color_image;
layout(binding = IMG_IN, r32ui) readonly uniform uimage2D atlas_image;

const vec3 NO_MAP = vec3(0.0);
const vec3 NOTHING_HIT = vec3(0.01, 0.02, 0.12);
// Where a picture has fewer pixels than the atlas texels, a pixel is the mean of at most this many a side.
const int MOST_TEXELS = 8;

vec3 texel_color(ivec2 texel, int map) {
    vec2 st = (vec2(texel) + 0.5) / float(ism.atlas.x) * 2.0 - 1.0;
    if (dot(st, st) > 1.0) {
        return NO_MAP;  // outside the hemisphere
    }
    uint bits = imageLoad(atlas_image, ism_origin(map) + texel).r;
    // Distances in render space are below 1, whatever the scene's size. Squared: most are near the middle.
    float distance = unpackHalf2x16(bits).y;
    return bits == ISM_EMPTY ? NOTHING_HIT : vec3(distance * distance);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, frame.size.xy))) {
        return;
    }
    int maps = only >= 0 ? 1 : ism.atlas.z;
    ivec2 cells = only >= 0 ? ivec2(1) : ivec2(ism.atlas.y, (maps + ism.atlas.y - 1) / ism.atlas.y);
    float side = min(float(frame.size.x) / float(cells.x), float(frame.size.y) / float(cells.y));
    vec2 low = 0.5 * (vec2(frame.size.xy) - side * vec2(cells));
    vec2 at = (vec2(pixel) + 0.5 - low) / side;
    vec3 color = NO_MAP;
    if (all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(cells)))) {
        ivec2 cell = ivec2(at);
        int map = only >= 0 ? only : (cells.y - 1 - cell.y) * cells.x + cell.x;
        int size = ism.atlas.x;
        int block = clamp(int(ceil(float(size) / side)), 1, MOST_TEXELS);
        ivec2 texel = ivec2(fract(at) * float(size)) - block / 2;
        for (int i = 0; map < ism.atlas.z && i < block * block; ++i) {
            ivec2 part = clamp(texel + ivec2(i % block, i / block), ivec2(0), ivec2(size - 1));
            color += texel_color(part, map) / float(block * block);
        }
    }
    imageStore(color_image, pixel, vec4(color, 1.0));
}
