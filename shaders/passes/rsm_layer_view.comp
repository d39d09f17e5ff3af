// SPDX-License-Identifier: Apache-2.0
// Shows one layer of an RSM: 0 depth, 1 position, 2 normal, 3 flux.
#define READ_RSM
#include "lib/frame.glsl"
#include "lib/map_layers.glsl"
#include "lib/rsm.glsl"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(binding = IMG_OUT, rgba32f) writeonly uniform image2D color_image;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, frame.size.xy))) {
        return;
    }
    vec2 st;
    int layer;
    vec3 color = vec3(0.0);
    PixelLight p;
    if (find_map_layer(pixel, st, layer) && read_pixel_light(st, layer, p)) {
#if LAYER == 0
        // Distances in render space are around 1, whatever the scene's size.
        color = vec3(length(p.position - light.position.xyz));
#elif LAYER == 1
        color = p.position + 0.5;
#elif LAYER == 2
        color = p.normal * 0.5 + 0.5;
#else
        color = p.color * (1.0 - p.metallic);
#endif
    }
    imageStore(color_image, pixel, vec4(color, 1.0));
}
