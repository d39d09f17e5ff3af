// SPDX-License-Identifier: Apache-2.0
//
// Places of an equirectangular image of the world and directions, as Cycles lays it out: the middle of its width is seen
// along +X, a quarter of it along -Z, its top along +Y of its own axes.
#ifndef LIB_ENVIRONMENT_DIRECTIONS
#define LIB_ENVIRONMENT_DIRECTIONS

#include "lib/math.glsl"

vec2 environment_place(vec3 d) {
    return vec2(0.5 + atan(d.z, d.x) / (2.0 * PI), atan(length(d.xz), d.y) / PI);
}

vec3 environment_direction(vec2 place) {
    float azimuth = 2.0 * PI * (place.x - 0.5);
    float polar = PI * place.y;
    return vec3(sin(polar) * cos(azimuth), cos(polar), sin(polar) * sin(azimuth));
}

#endif
