// SPDX-License-Identifier: Apache-2.0
layout(location = 0) flat in vec3 in_inside;
layout(location = 1) flat in vec3 in_rim;
layout(location = 0) out vec4 out_color;

void main() {
    float r = length(gl_PointCoord * 2.0 - 1.0);
    if (r > 1.0) {
        discard;
    }
    out_color = vec4(r < 0.6 ? in_inside : in_rim, 1.0);
}
