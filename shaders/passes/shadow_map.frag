// SPDX-License-Identifier: Apache-2.0
// Depth alone; does something only where an alpha test cuts holes.
#include "lib/alpha_test.glsl"

void main() {
    alpha_test();
}
