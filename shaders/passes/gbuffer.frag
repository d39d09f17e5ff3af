// SPDX-License-Identifier: Apache-2.0
#include "lib/gbuffer.glsl"
#include "lib/material.glsl"

layout(location = 0) out vec4 out_gbuffer0;
layout(location = 1) out vec4 out_gbuffer1;
#ifdef WRITE_EMISSION
layout(location = 2) out vec4 out_emission;
#endif

void main() {
    vec3 emission;
    Surface s = material_surface(emission);
    out_gbuffer0 = vec4(s.base_color, s.roughness);
    out_gbuffer1 = pack_gbuffer1(s);
#ifdef WRITE_EMISSION
    out_emission = vec4(emission, 1.0);
#endif
}
