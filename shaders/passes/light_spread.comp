// SPDX-License-Identifier: Apache-2.0
//
// How much what the pixels of an interleaved block gather differs from the mean of the pixels around each, in the mean
// square: of the irradiance's channels, and of the glossy light's sum. Each of them gathers from other lights, so that it
// says how much other lights change a pixel's light; how the light itself changes over the block is in the mean. A thread
// a block.
#include "lib/bounced.glsl"
#include "lib/frame.glsl"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(binding = IMG_OUT, rgba16f) writeonly uniform image2D spread_image;
layout(binding = IMG_IN, rgba32ui) readonly uniform uimage2D bounced_image;
layout(binding = IMG_HISTORY, rgba32ui) readonly uniform uimage2D blurred_image;

void main() {
    ivec2 block = ivec2(gl_GlobalInvocationID.xy);
    ivec2 last = frame.size.xy - 1;
    vec4 squares = vec4(0.0);
    float count = 0.0;
    for (int i = 0; i < BLOCK * BLOCK; ++i) {
        ivec2 pixel = block * BLOCK + ivec2(i % BLOCK, i / BLOCK);
        uvec4 bits = imageLoad(bounced_image, min(pixel, last));
        bool there = uintBitsToFloat(bits.w) > 0.0 && all(lessThanEqual(pixel, last));
        BouncedLight own = unpack_bounced(bits);
        BouncedLight mean = unpack_bounced(imageLoad(blurred_image, min(pixel, last)));
        vec3 glossy = own.glossy - mean.glossy;
        vec4 off = vec4(own.irradiance - mean.irradiance, glossy.r + glossy.g + glossy.b);
        squares += there ? off * off : vec4(0.0);
        count += there ? 1.0 : 0.0;
    }
    if (all(lessThan(block, imageSize(spread_image)))) {
        imageStore(spread_image, block, min(sqrt(squares / max(count, 1.0)), vec4(65504.0)));
    }
}
