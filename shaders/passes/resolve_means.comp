// SPDX-License-Identifier: Apache-2.0
// The picture between the smooth and the sharp mean, and its estimated error; passes/accumulate.h.
#include "shared/bindings.h"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(location = 0) uniform int count;
layout(binding = TEX_DIRECT) uniform sampler2D smooth_mean;
layout(binding = TEX_INDIRECT) uniform sampler2D sharp_mean;
layout(binding = IMG_OUT, rgba32f) writeonly uniform image2D resolved;

// relMSE's denominator has this much more than the square (docs/metrics.md).
const float DARK = 0.01;

// Pixels to either side whose noise is taken together: more than the largest block of the interleaved gather that is
// of use here.
const int POOL = 4;
const float POOLED = float((2 * POOL + 1) * (2 * POOL + 1));

// How many times what noise explains the squared difference must be to count: three standard deviations.
const float SURELY = 9.0;

float luminance(vec3 color) {
    return dot(color, vec3(0.2126, 0.7152, 0.0722));
}

void main() {
    ivec2 size = textureSize(smooth_mean, 0);
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, size))) {
        return;
    }
    vec4 smooth_here = texelFetch(smooth_mean, pixel, 0);
    vec4 sharp_here = texelFetch(sharp_mean, pixel, 0);
    // Variances of means of `count` pictures.
    float over = 1.0 / max(float(count) * float(count - 1), 1.0);
    float smooth_variance = smooth_here.a * over;
    float difference = 0.0;  // smooth less sharp
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            ivec2 p = clamp(pixel + ivec2(x, y), ivec2(0), size - 1);
            float weight = float((2 - abs(x)) * (2 - abs(y))) / 16.0;
            difference += weight * luminance(texelFetch(smooth_mean, p, 0).rgb - texelFetch(sharp_mean, p, 0).rgb);
        }
    }
    const float SQUARED_WEIGHTS = 36.0 / 256.0;  // their sum
    // A pixel that was missed by rare bright lights so far knows nothing of them; its neighbours do.
    float sharp_variance = 0.0;
    float both_variances = 0.0;
    for (int y = -POOL; y <= POOL; ++y) {
        for (int x = -POOL; x <= POOL; ++x) {
            ivec2 p = clamp(pixel + ivec2(x, y), ivec2(0), size - 1);
            float of_sharp = texelFetch(sharp_mean, p, 0).a * over;
            sharp_variance += of_sharp;
            both_variances += of_sharp + texelFetch(smooth_mean, p, 0).a * over;
        }
    }
    sharp_variance /= POOLED;
    both_variances /= POOLED;
    float missing = max(difference * difference - SQUARED_WEIGHTS * both_variances, 0.0);  // squared
    bool surely = difference * difference > SURELY * SQUARED_WEIGHTS * both_variances;
    float share = count > 1 && surely && missing > 0.0 ? missing / (missing + sharp_variance) : 0.0;
    vec3 color = mix(smooth_here.rgb, sharp_here.rgb, share);
    float noise = mix(sqrt(smooth_variance), sqrt(sharp_variance), share);
    float squared = noise * noise + (1.0 - share) * (1.0 - share) * missing;
    // What is off is taken to have the colour of what is shown.
    float shown = luminance(color);
    vec3 tint = shown > 1e-6 ? color / shown : vec3(1.0);
    vec3 relative = squared * tint * tint / (color * color + DARK);
    imageStore(resolved, pixel, vec4(color, dot(relative, vec3(1.0 / 3.0))));
}
