// SPDX-License-Identifier: Apache-2.0
//
// The pixels that virtual point lights are judged by (Ritschel et al. 2011, "Making Imperfect Shadow Maps View-Adaptive",
// section 4.1): points of the Halton sequence over the picture, the same in every frame.
#define READ_GBUFFER
#include "lib/halton.glsl"
#include "lib/importance_pixels.glsl"

layout(local_size_x = GROUP_1D) in;
layout(location = 0) uniform int count;
layout(location = 1) uniform uint seed;  // 0: the sequence itself

void main() {
    int index = int(gl_GlobalInvocationID.x);
    if (index >= count) {
        return;
    }
    vec2 h = vec2(radical_inverse(2u, uint(index)), radical_inverse(3u, uint(index)));
    if (seed != 0u) {
        h = fract(h + seeded_turn(seed, 0x1f00u));
    }
    ivec2 pixel = min(ivec2(h * vec2(frame.size.xy)), frame.size.xy - 1);
    Surface s;
    float depth = read_surface_unbranched(pixel, s);
    importance_pixels[index] =
        pack_importance_pixel(s, direction_to_viewer(s.position), depth > 0.0 ? 1.0 / float(count) : 0.0);
}
