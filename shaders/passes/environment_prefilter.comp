// SPDX-License-Identifier: Apache-2.0
//
// One level of the world's image as lobes of one roughness see it: averaged over GGX's reflected directions, seen head on,
// by filtered importance sampling (Krivanek and Colbert 2008, "Real-time Shading with Filtered Importance Sampling"): each
// sample is looked up in the level of the image whose texels are as wide as what the sample stands for.
#include "lib/environment.glsl"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(location = 0) uniform ivec2 size;
layout(location = 1) uniform float alpha;
layout(binding = IMG_OUT, rgba32f) writeonly uniform image2D level_image;

const int SAMPLES = 256;

float radical_inverse_2(uint i) {
    return float(bitfieldReverse(i)) * 2.3283064365386963e-10;
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    vec3 n = environment_direction((vec2(texel) + 0.5) / vec2(size));
    vec3 t, b;
    orthonormal_basis(n, t, b);
    float alpha2 = alpha * alpha;
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int i = 0; i < SAMPLES; ++i) {
        vec2 u = vec2((float(i) + 0.5) / float(SAMPLES), radical_inverse_2(uint(i)));
        float cos2 = (1.0 - u.x) / (1.0 + (alpha2 - 1.0) * u.x);
        float cosine = sqrt(cos2);
        float sine = sqrt(max(1.0 - cos2, 0.0));
        vec3 h = sine * cos(2.0 * PI * u.y) * t + sine * sin(2.0 * PI * u.y) * b + cosine * n;
        vec3 l = 2.0 * cosine * h - n;
        float n_dot_l = 2.0 * cos2 - 1.0;
        // Density of l is D(h) (n.h) / (4 h.n), and h.n is n.h: the viewer is at n.
        float d = cos2 * (alpha2 - 1.0) + 1.0;
        float density = alpha2 / (PI * d * d * 4.0);
        float radians = sqrt(1.0 / (float(SAMPLES) * density));
        // What D leaves of the lobe seen head on: Smith's shadowing towards the light.
        float weight = n_dot_l > 0.0 ? 2.0 * n_dot_l / (n_dot_l + sqrt(n_dot_l * n_dot_l * (1.0 - alpha2) + alpha2)) : 0.0;
        float level = clamp(log2(radians / world.detail.x), 0.0, world.detail.y);
        sum += weight * textureLod(environment_texture, environment_place(l), level).rgb;
        weights += weight;
    }
    if (all(lessThan(texel, size))) {
        imageStore(level_image, texel, vec4(sum / max(weights, 1e-6), 1.0));
    }
}
