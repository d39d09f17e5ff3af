// SPDX-License-Identifier: Apache-2.0
//
// The approximate visibility grid as the camera sees it, by the rays that are traced through it: base colour, shaded by the
// normal.
#include "lib/avg_trace.glsl"
#include "lib/frame.glsl"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(binding = IMG_OUT, rgba32f) writeonly uniform image2D color_image;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, frame.size.xy))) {
        return;
    }
    vec2 ndc = (vec2(pixel) + 0.5) / vec2(frame.size.xy) * 2.0 - 1.0;
    // Depth is 1 near and 0 far.
    vec4 near = frame.render_from_clip * vec4(ndc, 1.0, 1.0);
    vec4 middle = frame.render_from_clip * vec4(ndc, 0.5, 1.0);
    vec3 from = near.xyz / near.w;
    vec3 direction = normalize(middle.xyz / middle.w - from);
    AvgHit hit;
    vec3 color = vec3(0.0);
    if (trace_avg(from, direction, vec3(0.0), vec2(0.0), hit)) {
        // Brighter from above and from the right, so that the walls of a box differ.
        float light = 0.55 + 0.25 * hit.normal.y + 0.12 * hit.normal.x + 0.08 * hit.normal.z;
        color = (hit.color + 0.05) * light;
    }
    imageStore(color_image, pixel, vec4(color, 1.0));
}
