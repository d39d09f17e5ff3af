// SPDX-License-Identifier: Apache-2.0
//
// A shadow map's depth comparison as a Fourier series, whose terms can be filtered before the receiver's depth is known
// (Annen et al. 2007, "Convolution Shadow Maps"; 2008, "Real-Time, All-Frequency Shadows in Dynamic Scenes", which Lv et
// al. 2009, "A Fast Method for Real-time Computation of Approximated Global Illumination", take for direct light).
// ORDER terms; SOFT_KIND is the map's kind.
//
// Of a map's layer there are BASIS_LAYERS: the sines and cosines, the same times the depth, and the depth. Depths are even
// along the light's axis, 0 at the nearest surface of the map and MOST_DEPTH at the farthest.
#ifndef LIB_CONVOLUTION
#define LIB_CONVOLUTION

#include "lib/math.glsl"
#include "shared/bindings.h"
#include "shared/types.h"

const float DAMPING = 1.0;

const int SERIES_LAYERS = (ORDER + 1) / 2;
const int BASIS_LAYERS = 2 * SERIES_LAYERS + 1;

// The series has period 2, so that depths which are 1 apart look as if they were equal. It has risen at 1 / (2 ORDER).
const float MOST_DEPTH = 1.0 - 0.5 / float(ORDER);

// Frequencies of terms 2 i and 2 i + 1.
vec2 frequencies(int i) {
    return PI * vec2(4 * i + 1, 4 * i + 3);
}

// Sine and cosine of term 2 i, then of 2 i + 1, at a depth.
vec4 series(int i, float depth) {
    vec2 c = frequencies(i) * depth;
    return vec4(sin(c.x), cos(c.x), sin(c.y), cos(c.y));
}

vec4 basis(int layer, float depth) {
    if (layer == 2 * SERIES_LAYERS) {
        return vec4(depth, 0.0, 0.0, 0.0);
    }
    vec4 v = series(layer % SERIES_LAYERS, depth);
    return layer < SERIES_LAYERS ? v : v * depth;
}

// Of terms 2 i and 2 i + 1. Damping takes the ringing out of a series that ends (Annen et al. 2007, section 3.3).
vec2 term_weights(int i) {
    vec2 k = vec2(2 * i + 1, 2 * i + 2);
    vec2 damping = exp(-DAMPING * (k / float(ORDER)) * (k / float(ORDER)));
    return damping * vec2(1.0, k.y <= float(ORDER)) * 2.0 / frequencies(i);
}

// What turns means of series(i, z) over a part of a map into terms of the mean of z >= depth, less one half.
vec4 comparison(int i, float depth) {
    vec4 at = series(i, depth);
    vec2 w = term_weights(i);
    return vec4(at.y * w.x, -at.x * w.x, at.w * w.y, -at.z * w.y);
}

// One minus twice the series where the map is nearer than the receiver by `apart`: 1 for a series without end.
float response(float apart) {
    float sum = 0.0;
    for (int i = 0; i < SERIES_LAYERS; ++i) {
        sum += 2.0 * dot(term_weights(i), sin(frequencies(i) * apart));
    }
    return sum;
}

// Distance along the light's axis for what the map stores; view: see GpuShadowView.
float linear_depth(float stored, GpuShadowView view) {
#if SOFT_KIND == MAP_ORTHOGRAPHIC
    return (1.0 - stored) * view.origin.w;
#else
    return view.origin.w / max(stored, 1e-30);
#endif
}

// range: nearest and farthest distance in the map.
float unit_depth(float distance, vec2 range) {
    return clamp((distance - range.x) / max(range.y - range.x, 1e-20), 0.0, 1.0) * MOST_DEPTH;
}

float distance_of(float unit, vec2 range) {
    return mix(range.x, range.y, unit / MOST_DEPTH);
}

#endif
