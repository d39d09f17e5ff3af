// SPDX-License-Identifier: Apache-2.0
//
// Averages the depth samples of 3 x 3 pixels by Cycles' pixel filter where surfaces meet. Elsewhere a pixel is left as it is: what it
// shows of one surface is filtered already, textures by their levels of detail and shadows by lib/shadow.glsl.
#include "lib/frame.glsl"
#include "lib/sample_sources.glsl"

#ifdef LAYER
#define PICTURE vec4  // radiance times alpha, and alpha
#else
#define PICTURE vec3
#endif

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(location = 0) uniform float weights[9 * AA_SAMPLES];  // of the samples of 3 x 3 pixels
layout(binding = IMG_OUT, rgba32f) writeonly uniform image2D color_image;
layout(binding = IMG_IN, rgba32f) readonly uniform image2D picture_image;
layout(binding = IMG_SOURCES, r16ui) readonly uniform uimage2D sources_image;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 last = frame.size.xy - 1;
    if (any(greaterThan(pixel, last))) {
        return;
    }
    uint sources[9];
    bool all_self = true;
    for (int k = 0; k < 9; ++k) {
        ivec2 offset = source_offset(uint(k));
        ivec2 place = clamp(pixel + offset, ivec2(0), last);
        sources[k] = imageLoad(sources_image, place).r;
        all_self = all_self && sources[k] == ALL_SELF;
    }
    PICTURE color = PICTURE(imageLoad(picture_image, pixel));
    if (!all_self) {
        color = PICTURE(0.0);
        for (int k = 0; k < 9; ++k) {
            ivec2 place = clamp(pixel + source_offset(uint(k)), ivec2(0), last);
            for (int s = 0; s < AA_SAMPLES; ++s) {
                float weight = weights[AA_SAMPLES * k + s];
                if (weight > 0.0) {
                    ivec2 from = clamp(place + source_offset(source_of(sources[k], s)), ivec2(0), last);
                    color += weight * PICTURE(imageLoad(picture_image, from));
                }
            }
        }
    }
#ifdef LAYER
    imageStore(color_image, pixel, color);
#else
    imageStore(color_image, pixel, vec4(color, 1.0));
#endif
}
