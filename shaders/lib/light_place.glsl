// SPDX-License-Identifier: Apache-2.0
//
// A place on a light with a size, and what it sends to a receiver.
#ifndef LIB_LIGHT_PLACE
#define LIB_LIGHT_PLACE

#include "lib/light.glsl"

struct SoftReceiver {
    vec3 position;
    vec3 normal;       // for shading
    vec3 plane;        // the triangle's own
    vec3 right;        // steps on its plane from a pixel to the next
    vec3 up;
    float slack;       // what the offset of one pixel may stand out of the plane
};

// What a place counts at a receiver, up to a factor that all places share. to_light: unit, towards the place; squared: its
// distance (1 for a sun).
float place_weight(vec3 normal, vec3 to_light, float squared) {
    float weight = max(dot(normal, to_light), 0.0);
#if PROFILE != PROFILE_UNIFORM
    vec3 from_light = -light_vector_from_render(to_light);
    float profile = light_profile(from_light);
#if PROFILE == PROFILE_AREA
    // A narrow spread may miss every place; then the one that looks nearest to its direction tells.
    float out_ = light.area.z * length(from_light.xy) / max(from_light.z, 1e-3);
    profile += light.area.z > 0.0 && from_light.z > 0.0 ? 1e-5 / (1.0 + out_ * out_ * out_ * out_) : 0.0;
    weight /= squared;
#endif
    weight *= profile;
#endif
    return weight;
}

#endif
