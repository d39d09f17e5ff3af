// SPDX-License-Identifier: Apache-2.0
//
// A light, its profile and the projection of its maps. MAP_KIND and PROFILE are compiled in.
#ifndef LIB_LIGHT
#define LIB_LIGHT

#include "lib/math.glsl"
#include "shared/bindings.h"
#include "shared/types.h"

layout(std140, binding = UBO_LIGHT) uniform LightBlock {
    GpuLight light;
};

// Coordinates in the light's frame: along the map's s and t and along its axis.
vec3 light_from_render(vec3 position) {
    vec3 d = position - light.position.xyz;
    return vec3(dot(d, light.tangent.xyz), dot(d, light.bitangent.xyz), dot(d, light.axis.xyz));
}

vec3 light_vector_from_render(vec3 v) {
    return vec3(dot(v, light.tangent.xyz), dot(v, light.bitangent.xyz), dot(v, light.axis.xyz));
}

vec3 render_from_light_vector(vec3 v) {
    return light.tangent.xyz * v.x + light.bitangent.xyz * v.y + light.axis.xyz * v.z;
}

// 1 less the cosine to the axis, with all its digits where that is narrow: a cone of a tenth of a degree has cosines of
// a few steps of a float below 1.
float versine_to_axis(vec3 direction) {
    return direction.z > 0.0 ? dot(direction.xy, direction.xy) / (1.0 + direction.z) : 1.0 - direction.z;
}

// Share of a spot of Cycles within its cone and the soft rim.
float within_cone(vec3 direction) {
    float within = light.cone.x - versine_to_axis(direction);
    float t = light.cone.y > 0.0 ? clamp(within * light.cone.y, 0.0, 1.0) : float(within > 0.0);
    return t * t * (3.0 - 2.0 * t);
}

// Emission towards a unit direction of the light's frame, relative to the axis. Cycles' laws as measured
// in docs/lights.md; Khronos' from KHR_lights_punctual.
float light_profile(vec3 direction) {
#if PROFILE == PROFILE_SPOT_CYCLES_3
    return max(direction.z, 0.0) * within_cone(direction);
#elif PROFILE == PROFILE_SPOT_CYCLES_4
    return within_cone(direction);
#elif PROFILE == PROFILE_SPOT_KHRONOS
    float t = clamp(direction.z * light.cone.x + light.cone.y, 0.0, 1.0);
    return t * t;
#elif PROFILE == PROFILE_AREA
    // One-sided Lambertian, dimmed by the slats of a soft box where the spread is below 180 degrees.
    float c = max(direction.z, 0.0);
    float s = sqrt(max(1.0 - c * c, 0.0));
    return max(c - s * light.area.z, 0.0) * light.area.w;
#else
    return 1.0;
#endif
}

// Layers of a cube map: 2 * axis + (negative ? 1 : 0); s and t run along the next two axes. The same
// convention builds the faces' matrices in renderer/light_setup.cpp.
void cube_face(vec3 v, out int face, out vec2 st, out float depth) {
    vec3 a = abs(v);
    if (a.x >= a.y && a.x >= a.z) {
        face = v.x < 0.0 ? 1 : 0;
        depth = a.x;
        st = v.yz;
    } else if (a.y >= a.z) {
        face = v.y < 0.0 ? 3 : 2;
        depth = a.y;
        st = v.zx;
    } else {
        face = v.z < 0.0 ? 5 : 4;
        depth = a.z;
        st = v.xy;
    }
    st /= max(depth, 1e-30);
}

vec3 cube_direction(int face, vec2 st) {
    float s = (face & 1) == 1 ? -1.0 : 1.0;
    return face < 2 ? vec3(s, st.x, st.y) : face < 4 ? vec3(st.y, s, st.x) : vec3(st.x, st.y, s);
}

#endif
