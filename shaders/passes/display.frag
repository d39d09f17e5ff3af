// SPDX-License-Identifier: Apache-2.0
// Scene-linear light to what the window shows: the same function as to_display in image/view_transform.
#include "shared/display.h"

layout(binding = TEX_DISPLAY_COLOR) uniform sampler2D color_texture;
layout(location = LOC_DISPLAY_SCALE) uniform float scale;        // 2 to the exposure
layout(location = LOC_DISPLAY_EXPONENT) uniform float exponent;  // 1 over the gamma
layout(location = LOC_DISPLAY_SIZE) uniform vec2 window_size;
layout(location = 0) out vec4 result;

// IEC 61966-2-1.
float srgb_from_linear(float linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
}

#ifdef LATTICE
layout(binding = TEX_DISPLAY_LATTICE) uniform sampler2DArray lattice;
layout(location = LOC_DISPLAY_LATTICE_RANGE) uniform vec2 lattice_stops;

vec3 node(ivec3 at) {
    return texelFetch(lattice, at, 0).rgb;
}

// Interpolates in the tetrahedron of the cell that holds the colour, between the corners passed when the
// axes are walked from the largest part to the smallest: the grey axis stays grey, and tables like
// Filmic's are read as OpenColorIO reads them.
vec3 view_transform(vec3 linear) {
    int last = textureSize(lattice, 0).x - 1;
    vec3 stops = log2(max(linear, vec3(exp2(lattice_stops.x))));
    vec3 at = clamp((stops - lattice_stops.x) / (lattice_stops.y - lattice_stops.x), 0.0, 1.0) * float(last);
    ivec3 cell = min(ivec3(at), ivec3(last - 1));
    vec3 f = at - vec3(cell);
    float largest = max(max(f.r, f.g), f.b);
    float smallest = min(min(f.r, f.g), f.b);
    float middle = f.r + f.g + f.b - largest - smallest;
    ivec3 first = f.r == largest ? ivec3(1, 0, 0) : (f.g == largest ? ivec3(0, 1, 0) : ivec3(0, 0, 1));
    // Of axes with equal parts any may be the last but the one that came first.
    ivec3 without = f.b == smallest && first.b == 0   ? ivec3(1, 1, 0)
                    : f.g == smallest && first.g == 0 ? ivec3(1, 0, 1)
                                                      : ivec3(0, 1, 1);
    return node(cell) * (1.0 - largest) + node(cell + first) * (largest - middle) +
           node(cell + without) * (middle - smallest) + node(cell + 1) * smallest;
}
#else
vec3 view_transform(vec3 linear) {
    return vec3(srgb_from_linear(linear.r), srgb_from_linear(linear.g), srgb_from_linear(linear.b));
}
#endif

// Below 0, and what is no number, is black, as in 8-bit files.
vec3 at_least_black(vec3 color) {
    return vec3(color.r > 0.0 ? color.r : 0.0, color.g > 0.0 ? color.g : 0.0, color.b > 0.0 ? color.b : 0.0);
}

void main() {
    vec3 linear;
    if (textureSize(color_texture, 0) == ivec2(window_size)) {
        linear = texelFetch(color_texture, ivec2(gl_FragCoord.xy), 0).rgb;
    } else {
        linear = texture(color_texture, gl_FragCoord.xy / window_size).rgb;
    }
    vec3 display = view_transform(at_least_black(linear * scale));
    if (exponent != 1.0) {
        display = pow(display, vec3(exponent));
    }
    result = vec4(clamp(display, 0.0, 1.0), 1.0);
}
