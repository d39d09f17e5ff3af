// SPDX-License-Identifier: Apache-2.0
// What one virtual point light's map leaves lit.
#define READ_GBUFFER
#include "lib/gbuffer.glsl"
#include "lib/ism_lookup.glsl"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(location = 0) uniform int light;
layout(binding = IMG_OUT, rgba32f) writeonly uniform image2D color_image;

const vec3 LIT = vec3(1.0, 0.75, 0.3);
const vec3 HIDDEN = vec3(0.06, 0.12, 0.6);
const vec3 AWAY = vec3(0.12);  // the light or the surface faces away: no map is asked
const float COPLANAR = 1e-3;   // as good as away

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, frame.size.xy))) {
        return;
    }
    vec3 color = vec3(0.0);
    Surface s;
    if (read_surface(pixel, s)) {
        GpuVpl vpl = vpls[light];
        vec3 d = s.position - vpl.position.xyz;
        float distance = sqrt(max(dot(d, d), 1e-30));
        vec3 w = d / distance;
        float cos_out = dot(vpl.normal.xyz, w);
        float cos_in = -dot(s.normal, w);
        float seen = 1.0;
#ifdef VISIBILITY
        seen = vpl_visibility(vpl, w, distance, cos_out, cos_in, float(ism.atlas.x));
#endif
        vec3 tint = min(cos_out, cos_in) < COPLANAR ? AWAY : mix(HIDDEN, LIT, seen);
        color = tint * (0.2 + 0.7 * abs(dot(s.normal, direction_to_viewer(s.position))));
    }
    imageStore(color_image, pixel, vec4(color, 1.0));
}
