// SPDX-License-Identifier: Apache-2.0
// In: a vector, any length; a place in the map and an area there. Out: the vector's place; its way back; solid angle.
#include "tests/harness.glsl"
#include "lib/paraboloid.glsl"

void test_item() {
    vec3 d = in_value(0).xyz;
    vec2 st = paraboloid_project(d, length(d));
    out_value(0, vec4(st, paraboloid_solid_angle(in_value(1).xy, in_value(1).z), 0.0));
    out_value(1, vec4(paraboloid_direction(st), 0.0));
    out_value(2, vec4(paraboloid_direction(in_value(1).xy), 0.0));
}
