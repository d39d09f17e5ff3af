// SPDX-License-Identifier: Apache-2.0
// Figure 5 of Dachsbacher and Stamminger 2005: red where no interpolation was possible.
#define READ_GBUFFER
#include "lib/gbuffer.glsl"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(binding = IMG_OUT, rgba32f) writeonly uniform image2D color_image;
layout(binding = TEX_INDIRECT) uniform sampler2D irradiance_texture;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, frame.size.xy))) {
        return;
    }
    Surface s;
    vec3 color = vec3(0.0);
    if (read_surface(pixel, s)) {
        bool full = texelFetch(irradiance_texture, pixel, 0).a < 0.5;
        float facing = 0.2 + 0.6 * abs(dot(s.normal, direction_to_viewer(s.position)));
        color = full ? vec3(0.8, 0.05, 0.05) : vec3(facing);
    }
    imageStore(color_image, pixel, vec4(color, 1.0));
}
