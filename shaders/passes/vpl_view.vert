// SPDX-License-Identifier: Apache-2.0
// Virtual point lights as dots over the picture.
#define READ_GBUFFER
#include "lib/gbuffer.glsl"
#include "lib/vpl.glsl"

layout(std140, binding = UBO_VIEW) uniform ViewBlock {
    ViewUniforms view;
};
layout(location = 0) uniform vec3 bounce_color;
layout(location = 1) uniform float radius;  // pixels
layout(location = 2) uniform int seen_ones;  // 1: those that the camera sees, 0: the others
layout(location = 0) flat out vec3 out_inside;
layout(location = 1) flat out vec3 out_rim;

// A light this much farther than what the pixel shows still lies on it: lights stand where texels of reflective
// shadow maps have their centres. Render units.
const float BEHIND = 0.004;

float along_view(vec3 position) {
    return dot(position - frame.camera_position.xyz, frame.camera_forward.xyz);
}

void main() {
    GpuVpl vpl = vpls[gl_VertexID];
    vec3 sent = vpl.intensity.rgb + vpl.glossy.rgb;
    float brightest = max(max(sent.r, sent.g), sent.b);
    vec4 clip = view.clip_from_render * vec4(vpl.position.xyz, 1.0);
    vec2 ndc = clip.xy / clip.w;
    bool inside = clip.w > 0.0 && all(lessThan(abs(ndc), vec2(1.0)));
    ivec2 pixel = clamp(ivec2((ndc * 0.5 + 0.5) * vec2(frame.size.xy)), ivec2(0), frame.size.xy - 1);
    float depth = inside ? texelFetch(depth_texture, pixel, 0).r : 0.0;
    bool seen = depth == 0.0 || along_view(vpl.position.xyz) <= along_view(pixel_position(pixel, depth)) + BEHIND;
    bool drawn = inside && brightest > 0.0 && seen == (seen_ones == 1);
    // Outside of what is drawn, where it is not to be.
    gl_Position = drawn ? vec4(ndc, 0.5, 1.0) : vec4(0.0, 0.0, -1.0, 1.0);
    gl_PointSize = 2.0 * radius * (seen ? 1.0 : 0.6);
    float dim = seen ? 1.0 : 0.3;
    out_inside = dim * sent / max(brightest, 1e-30);
    out_rim = dim * bounce_color;
}
