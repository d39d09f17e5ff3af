// SPDX-License-Identifier: Apache-2.0
// In: a vector. Out: the basis across it, and safe_normalize with the fallback (0, 1, 0).
#include "tests/harness.glsl"
#include "lib/math.glsl"

void test_item() {
    vec3 n = in_value(0).xyz;
    vec3 t;
    vec3 b;
    orthonormal_basis(n, t, b);
    out_value(0, vec4(t, 0.0));
    out_value(1, vec4(b, 0.0));
    out_value(2, vec4(safe_normalize(n, vec3(0.0, 1.0, 0.0)), 0.0));
}
