// SPDX-License-Identifier: Apache-2.0
// Sums what surfaces reflect of bounced light, over the pixels of a tile and the channels.
#define READ_GBUFFER
#include "lib/bounced.glsl"
#include "lib/gbuffer.glsl"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(binding = IMG_IN, rgba32ui) readonly uniform uimage2D bounced_image;
layout(std430, binding = SSBO_ROW_SUMS) writeonly buffer SumBlock {
    float sums[];
};
shared float parts[GROUP_2D * GROUP_2D];

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    vec3 color = vec3(0.0);
    Surface s;
    if (all(lessThan(pixel, frame.size.xy)) && read_surface(pixel, s)) {
        BouncedLight b = unpack_bounced(imageLoad(bounced_image, pixel));
        color = (diffuse_albedo(s) / PI * b.irradiance + b.glossy) / frame.composite.w;
    }
    uint me = gl_LocalInvocationIndex;
    parts[me] = color.r + color.g + color.b;
    for (uint half_count = uint(GROUP_2D * GROUP_2D) / 2u; half_count > 0u; half_count /= 2u) {
        barrier();
        if (me < half_count) {
            parts[me] += parts[me + half_count];
        }
    }
    if (me == 0u) {
        sums[gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x] = parts[0];
    }
}
