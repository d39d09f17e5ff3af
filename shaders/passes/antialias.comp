// SPDX-License-Identifier: Apache-2.0
//
// Averages two by two samples a pixel by Cycles' pixel filter. Blackman-Harris of width 1.5 px there is the window over
// three pixels (film.cpp doubles the width it is given): samples a quarter, three quarters and five quarters of a
// pixel off weigh 0.396, 0.101 and 0.003; the last are left out.
#include "lib/frame.glsl"
#include "lib/sample_sources.glsl"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(binding = IMG_OUT, rgba32f) writeonly uniform image2D color_image;
layout(binding = IMG_IN, rgba32f) readonly uniform image2D picture_image;
layout(binding = IMG_SOURCES, r16ui) readonly uniform uimage2D sources_image;

const float NEAR_WEIGHT = 0.3984;
const float FAR_WEIGHT = 0.1016;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 last = frame.size.xy - 1;
    if (any(greaterThan(pixel, last))) {
        return;
    }
    vec3 plain = vec3(0.0);
    uint sources[9];
    bool all_self = true;
    for (int k = 0; k < 9; ++k) {
        ivec2 offset = source_offset(uint(k));
        ivec2 place = clamp(pixel + offset, ivec2(0), last);
        sources[k] = imageLoad(sources_image, place).r;
        all_self = all_self && sources[k] == ALL_SELF;
        float weight = (offset.x == 0 ? 2.0 * NEAR_WEIGHT : FAR_WEIGHT) * (offset.y == 0 ? 2.0 * NEAR_WEIGHT : FAR_WEIGHT);
        plain += weight * imageLoad(picture_image, place).rgb;
    }
    vec3 color = plain;
    if (!all_self) {
        color = vec3(0.0);
        // Four by four samples, those of this pixel in the middle.
        for (int k = 0; k < 16; ++k) {
            ivec2 at = ivec2(k & 3, k >> 2) - 1;
            ivec2 offset = ivec2(at.x < 0 ? -1 : at.x / 2, at.y < 0 ? -1 : at.y / 2);
            int s = (at.x & 1) + 2 * (at.y & 1);
            ivec2 place = clamp(pixel + offset, ivec2(0), last);
            ivec2 from = clamp(place + source_offset(source_of(sources[(offset.y + 1) * 3 + offset.x + 1], s)), ivec2(0), last);
            float weight = (offset.x == 0 ? NEAR_WEIGHT : FAR_WEIGHT) * (offset.y == 0 ? NEAR_WEIGHT : FAR_WEIGHT);
            color += weight * imageLoad(picture_image, from).rgb;
        }
    }
    imageStore(color_image, pixel, vec4(color, 1.0));
}
