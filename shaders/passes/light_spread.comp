// SPDX-License-Identifier: Apache-2.0
//
// How much what the pixels of an interleaved block gather differs from pixel to pixel: standard deviation of the
// irradiance's channels, and of the glossy light's sum. Each pixel gathers from other lights, so that it says how much
// other lights change a pixel's light. A thread a block; pixels off the plane of the block's middle are left out, for
// what differs there is the surface.
#define READ_GBUFFER
#include "lib/bounced.glsl"
#include "lib/gbuffer.glsl"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(binding = IMG_OUT, rgba16f) writeonly uniform image2D spread_image;
layout(binding = IMG_IN, rgba32ui) readonly uniform uimage2D bounced_image;
layout(binding = TEX_GEOMETRIC_NORMAL) uniform sampler2D geometric_normal_texture;

// How far off the plane a pixel may lie, in pixel widths at the middle.
const float PLANE_TOLERANCE = 1.0;

void main() {
    ivec2 block = ivec2(gl_GlobalInvocationID.xy);
    ivec2 last = frame.size.xy - 1;
    ivec2 first = block * BLOCK;
    ivec2 middle = min(first + BLOCK / 2, last);
    float depth = uintBitsToFloat(imageLoad(bounced_image, middle).w);
    vec3 position = pixel_position(middle, depth > 0.0 ? depth : 0.5);
    vec3 normal = octahedral_decode(texelFetch(geometric_normal_texture, middle, 0).xy * 2.0 - 1.0);
    float tolerance = PLANE_TOLERANCE * 2.0 * pixel_footprint(position);
    vec4 sum = vec4(0.0);
    vec4 squares = vec4(0.0);
    float count = 0.0;
    for (int i = 0; i < BLOCK * BLOCK; ++i) {
        ivec2 pixel = first + ivec2(i % BLOCK, i / BLOCK);
        uvec4 bits = imageLoad(bounced_image, min(pixel, last));
        float there = uintBitsToFloat(bits.w);
        vec3 off = pixel_position(pixel, there > 0.0 ? there : 0.5) - position;
        bool same = there > 0.0 && abs(dot(off, normal)) < tolerance && all(lessThanEqual(pixel, last));
        BouncedLight b = unpack_bounced(bits);
        vec4 light = same ? vec4(b.irradiance, b.glossy.r + b.glossy.g + b.glossy.b) : vec4(0.0);
        sum += light;
        squares += light * light;
        count += same ? 1.0 : 0.0;
    }
    vec4 mean = sum / max(count, 1.0);
    vec4 variance = max(squares / max(count, 1.0) - mean * mean, vec4(0.0));
    if (all(lessThan(block, imageSize(spread_image)))) {
        imageStore(spread_image, block, depth > 0.0 && count > 1.0 ? sqrt(variance) : vec4(0.0));
    }
}
