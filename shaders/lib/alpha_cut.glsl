// SPDX-License-Identifier: Apache-2.0
//
// Whether a fragment is cut away, by its alpha; with ALPHA_TEST.
#ifndef LIB_ALPHA_CUT
#define LIB_ALPHA_CUT

#include "shared/bindings.h"
#include "shared/types.h"

#ifdef BLEND_RULE
#if BLEND_RULE == BLEND_HASHED
#include "lib/alpha_threshold.glsl"
#elif BLEND_RULE == BLEND_PEEL
// Of the solid surfaces, and of what was peeled off before; 1 near, 0 far.
#ifdef PEEL_SAMPLES
layout(binding = TEX_DEPTH) uniform sampler2DMS solid_depth;
layout(binding = TEX_PEELED_DEPTH) uniform sampler2DMS peeled_depth;
#define PEEL_PLACE gl_SampleID
#else
layout(binding = TEX_DEPTH) uniform sampler2D solid_depth;
layout(binding = TEX_PEELED_DEPTH) uniform sampler2D peeled_depth;
#define PEEL_PLACE 0
#endif
#endif
#endif

bool is_cut(GpuMaterial m, float alpha) {
#ifndef BLEND_RULE
    return alpha < m.emission.a;
#elif BLEND_RULE == BLEND_HALF
    return alpha < 0.5;
#elif BLEND_RULE == BLEND_SOLID
    return alpha < ALPHA_SOLID;
#elif BLEND_RULE == BLEND_HASHED
    return alpha < ALPHA_NOTHING || alpha < ALPHA_SOLID && alpha < alpha_threshold();
#else
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = gl_FragCoord.z;
    return alpha < ALPHA_NOTHING || alpha >= ALPHA_SOLID || depth <= texelFetch(solid_depth, pixel, PEEL_PLACE).r ||
           depth >= texelFetch(peeled_depth, pixel, PEEL_PLACE).r;
#endif
}

#endif
