// SPDX-License-Identifier: Apache-2.0
// One more picture into the running means; passes/accumulate.h.
#include "shared/bindings.h"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(location = 0) uniform int number;  // of this picture, from 1
layout(binding = TEX_DIRECT) uniform sampler2D smooth_picture;
layout(binding = TEX_INDIRECT) uniform sampler2D sharp_picture;
layout(binding = IMG_OUT, rgba32f) uniform image2D smooth_mean;
layout(binding = IMG_OUT1, rgba32f) uniform image2D sharp_mean;

float luminance(vec3 color) {
    return dot(color, vec3(0.2126, 0.7152, 0.0722));
}

vec4 taken_in(vec4 mean, vec3 color) {
    vec3 d = color - mean.rgb;
    vec3 next = mean.rgb + d / float(number);
    return vec4(next, mean.a + luminance(d) * luminance(color - next));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(smooth_mean)))) {
        return;
    }
    vec4 smooth_before = number > 1 ? imageLoad(smooth_mean, pixel) : vec4(0.0);
    vec4 sharp_before = number > 1 ? imageLoad(sharp_mean, pixel) : vec4(0.0);
    imageStore(smooth_mean, pixel, taken_in(smooth_before, texelFetch(smooth_picture, pixel, 0).rgb));
    imageStore(sharp_mean, pixel, taken_in(sharp_before, texelFetch(sharp_picture, pixel, 0).rgb));
}
