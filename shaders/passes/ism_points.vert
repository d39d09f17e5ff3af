// SPDX-License-Identifier: Apache-2.0
// The same squares as GL_POINTS into one atlas (Ritschel et al. 2008, 3.2): a vertex shader deals points out to maps.
#include "lib/splat.glsl"

layout(std430, binding = SSBO_POINTS) readonly buffer PointBlock { uvec4 points[]; };
layout(location = 0) uniform vec2 atlas_size;
layout(location = 0) flat out ivec2 out_origin;

void main() {
    int map = gl_VertexID / ism.atlas.w;
    float map_size = float(ism.atlas.x);
    Splat s;
    bool seen = see_point(vpls[map], points[point_place(map, gl_VertexID % ism.atlas.w)], map_size, s);
    out_origin = ism_origin(map);
    // Depth 1 at the light, 0 at infinity.
    gl_Position = seen ? vec4((vec2(out_origin) + s.place) / atlas_size * 2.0 - 1.0, 1.0 / (1.0 + s.distance), 1.0)
                       : vec4(0.0, 0.0, -1.0, 1.0);
    gl_PointSize = max(2.0 * s.half_side, 1.0);
}
