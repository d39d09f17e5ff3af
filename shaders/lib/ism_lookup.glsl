// SPDX-License-Identifier: Apache-2.0
#ifndef LIB_ISM_LOOKUP
#define LIB_ISM_LOOKUP

#include "lib/ism.glsl"

// Read as an image: on llvmpipe a plain load costs a third of a texel fetch.
layout(binding = IMG_ISM, r32ui) readonly uniform uimage2D ism_image;

// 1 where nothing in the light's map is nearer than a receiver along the unit vector w at a distance, under the
// cosines cos_out at the light and cos_in at the receiver. size: texels a side of the map.
float vpl_visibility(GpuVpl vpl, vec3 w, float distance, float cos_out, float cos_in, float size) {
    float scale = 1.0 + max(cos_out, 0.0);
    vec2 st = vec2(dot(w, vpl.tangent.xyz), dot(w, vpl.bitangent.xyz)) / scale;
    uint origin = floatBitsToUint(vpl.bitangent.w);
    vec2 at = clamp((st * 0.5 + 0.5) * size, vec2(0.0), vec2(size - 0.01));
    ivec2 texel = ivec2(at);
    uint bits = imageLoad(ism_image, texel + ivec2(origin & 0xffffu, origin >> 16)).r;
#ifdef SLOPE_BIAS
    // Splats of one depth: a receiver's distance changes across a texel with the slope of its plane against the ray.
    float slope = min(sqrt(max(1.0 - cos_in * cos_in, 0.0)) / max(cos_in, 1e-4), 20.0);
    float bias = ism.splat.z + ism.splat.w * (distance * scale * 2.0 / size) * slope;
#else
    const float bias = 0.0;  // the texel's own slope sees to it
#endif
    return ism_lit(bits, distance - bias, at - vec2(texel) - 0.5) ? 1.0 : 0.0;
}

// The same of a light at infinity, for a receiver at a place in render space.
float distant_visibility(GpuVpl vpl, vec3 position, float size) {
    vec3 p = vpl_from_render(vpl, position - vpl.position.xyz) / distant_reach(vpl);
    uint origin = floatBitsToUint(vpl.bitangent.w);
    vec2 at = clamp((p.xy * 0.5 + 0.5) * size, vec2(0.0), vec2(size - 0.01));
    ivec2 texel = ivec2(at);
    uint bits = imageLoad(ism_image, texel + ivec2(origin & 0xffffu, origin >> 16)).r;
    bool beside = max(abs(p.x), abs(p.y)) > 1.0;
    return beside || distant_lit(bits, p.z, at - vec2(texel) - 0.5, size) ? 1.0 : 0.0;
}

#endif
