// SPDX-License-Identifier: Apache-2.0
//
// A layer of blended surfaces over the picture behind it, in place (Porter and Duff 1984, "Compositing Digital Images").
#include "lib/frame.glsl"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(binding = IMG_OUT, rgba32f) uniform image2D picture_image;
layout(binding = IMG_IN, rgba32f) readonly uniform image2D layer_image;  // radiance times alpha, and alpha

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, frame.size.xy))) {
        return;
    }
    vec4 layer = imageLoad(layer_image, pixel);
    vec4 behind = imageLoad(picture_image, pixel);
    imageStore(picture_image, pixel, vec4(behind.rgb * (1.0 - layer.a) + layer.rgb, behind.a));
}
