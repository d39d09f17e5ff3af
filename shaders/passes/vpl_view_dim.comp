// SPDX-License-Identifier: Apache-2.0
// Dims the picture, its brightest parts most, so that dots stand out from it.
#include "lib/frame.glsl"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(binding = IMG_OUT, rgba32f) uniform image2D color_image;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, frame.size.xy))) {
        return;
    }
    vec3 color = imageLoad(color_image, pixel).rgb;
    float brightest = max(max(color.r, color.g), color.b);
    imageStore(color_image, pixel, vec4(0.35 * color / (1.0 + max(brightest, 0.0)), 1.0));
}
