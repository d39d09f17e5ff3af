// SPDX-License-Identifier: Apache-2.0
//
// Averages interleaved light along one axis so that each of the n subsets of lights counts alike; pixels off the
// receiver's plane are left out. As written over n + 1 pixels, the outer two by half: on a plane nothing is left of the
// pattern where each light itself changes little over a block. TENT: over 2 n - 1 pixels with weights that fall to both
// sides, where glossy lobes make it change more: the pattern's gradient goes as well.
//
// In screen space a plane's depth (1/z, or z without perspective) is linear, so the test is one comparison of
// depths: with the plane's clip-space coefficients c, depth = -(c.x x + c.y y + c.w) / c.z.
#define READ_GBUFFER
#include "lib/bounced.glsl"
#include "lib/gbuffer.glsl"
#include "shared/types.h"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(location = 0) uniform int n;
layout(binding = IMG_OUT, rgba32ui) writeonly uniform uimage2D blurred_image;
layout(binding = IMG_IN, rgba32ui) readonly uniform uimage2D bounced_image;
layout(binding = TEX_GEOMETRIC_NORMAL) uniform sampler2D geometric_normal_texture;

// How far off the plane a neighbour may lie, in pixel widths at the receiver.
const float PLANE_TOLERANCE = 0.7;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 last = frame.size.xy - 1;
    uvec4 center = imageLoad(bounced_image, min(pixel, last));
    float depth = uintBitsToFloat(center.w);
    vec3 position = pixel_position(min(pixel, last), depth > 0.0 ? depth : 0.5);
    // The triangle's own normal: a normal map tilts what is shaded, not where the surface goes on.
    vec3 normal = octahedral_decode(texelFetch(geometric_normal_texture, min(pixel, last), 0).xy * 2.0 - 1.0);
    vec4 c = vec4(normal, -dot(normal, position)) * frame.render_from_clip;
    float per_depth = c.z == 0.0 ? 0.0 : 1.0 / c.z;
#ifdef VERTICAL
    const ivec2 axis = ivec2(0, 1);
    float slope = -2.0 * c.y * per_depth / float(frame.size.y);
#else
    const ivec2 axis = ivec2(1, 0);
    float slope = -2.0 * c.x * per_depth / float(frame.size.x);
#endif
    // At a distance e off the plane depth differs by e / (w c.z), and a pixel's width is proportional to w.
    float tolerance = abs(per_depth) * PLANE_TOLERANCE * 2.0 * frame.interpolation.z;
    vec3 irradiance = vec3(0.0);
    vec3 glossy = vec3(0.0);
    float weights = 0.0;
#ifdef TENT
    int reach = n - 1;
#else
    int reach = n / 2;
#endif
    for (int i = -reach; i <= reach; ++i) {
        ivec2 tap = pixel + i * axis;
        uvec4 bits = imageLoad(bounced_image, clamp(tap, ivec2(0), last));
        float tap_depth = uintBitsToFloat(bits.w);
        bool same = abs(tap_depth - (depth + slope * float(i))) < tolerance && tap == clamp(tap, ivec2(0), last) &&
                    tap_depth > 0.0;
#ifdef TENT
        float share = float(n - abs(i));
#else
        float share = abs(i) == reach ? 0.5 : 1.0;
#endif
        float weight = same || i == 0 ? share : 0.0;
        BouncedLight b = unpack_bounced(bits);
        irradiance += weight * b.irradiance;
        glossy += weight * b.glossy;
        weights += weight;
    }
    if (any(greaterThan(pixel, last))) {
        return;
    }
    BouncedLight mean;
    mean.irradiance = irradiance / weights;
    mean.glossy = glossy / weights;
    imageStore(blurred_image, pixel, pack_bounced(mean, depth));
}
