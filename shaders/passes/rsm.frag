// SPDX-License-Identifier: Apache-2.0
#include "lib/material.glsl"
#include "lib/rsm.glsl"

layout(location = 5) in vec3 in_light_space;
layout(location = 0) out uvec4 out_rsm;

void main() {
    vec3 emission;
    Surface s = material_surface(emission);
#if MAP_KIND == MAP_CUBE
    float depth = max(max(abs(in_light_space.x), abs(in_light_space.y)), abs(in_light_space.z));
#else
    float depth = in_light_space.z;
#endif
#if MAP_KIND == MAP_ORTHOGRAPHIC
    float profile = 1.0;
#else
    float squared = dot(in_light_space, in_light_space);
    // The light's radius weakens it near by as in passes/direct_light.comp.
    float profile = light_profile(safe_normalize(in_light_space, vec3(0.0, 0.0, 1.0))) * squared /
                    max(squared + light.intensity.w, 1e-30);
#endif
    out_rsm = pack_rsm(depth, s, profile);
}
