// SPDX-License-Identifier: Apache-2.0
//
// The pixels that virtual point lights are judged by (Ritschel et al. 2011, "Making Imperfect Shadow Maps View-Adaptive",
// section 4.1): points of the Halton sequence over the picture that show a surface, the same in every frame as long as
// these stay. Each has TRIES points of its own; where none of them shows one it judges nothing.
#define READ_GBUFFER
#include "lib/halton.glsl"
#include "lib/importance_pixels.glsl"

layout(local_size_x = GROUP_1D) in;
const int TRIES = 256;

layout(location = 0) uniform int count;
layout(location = 1) uniform uint seed;  // 0: the sequence itself

void main() {
    int index = int(gl_GlobalInvocationID.x);
    if (index >= count) {
        return;
    }
    vec2 turn = seed != 0u ? seeded_turn(seed, 0x1f00u) : vec2(0.0);
    ivec2 pixel = ivec2(0);
    float depth = 0.0;
    for (int i = 0; i < TRIES && depth == 0.0; ++i) {
        uint number = uint(index + i * count + 1);  // the first point is a corner
        vec2 h = fract(vec2(radical_inverse(2u, number), radical_inverse(3u, number)) + turn);
        pixel = min(ivec2(h * vec2(frame.size.xy)), frame.size.xy - 1);
        depth = texelFetch(depth_texture, pixel, 0).r;
    }
    Surface s;
    depth = read_surface_unbranched(pixel, s);
    importance_pixels[index] =
        pack_importance_pixel(s, direction_to_viewer(s.position), depth > 0.0 ? 1.0 / float(count) : 0.0);
}
