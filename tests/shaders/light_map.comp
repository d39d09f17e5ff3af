// SPDX-License-Identifier: Apache-2.0
// In: a point of render space. Out: layer, s, t and depth in the light's map as the passes find them, and the
// point again from the light's own coordinates.
#include "tests/harness.glsl"
#include "lib/light.glsl"

void test_item() {
    vec3 p = light_from_render(in_value(0).xyz);
    int layer = 0;
    vec2 st;
    float depth = p.z;
#if MAP_KIND == MAP_ORTHOGRAPHIC
    st = p.xy / vec2(light.tangent.w, light.bitangent.w);
#elif MAP_KIND == MAP_PERSPECTIVE
    st = p.xy / (p.z * light.axis.w);
#else
    cube_face(p, layer, st, depth);
#endif
    out_value(0, vec4(float(layer), st, depth));
    out_value(1, vec4(light.position.xyz + render_from_light_vector(p), 0.0));
}
