// SPDX-License-Identifier: Apache-2.0
//
// How many points a patch gives: those of its triangle's area, or this piece's part of them. Lines of points (isolines)
// are the one pattern of the tessellator whose number of points can be said; a few too many are left out after it.
#include "lib/patch.glsl"

layout(vertices = 1) out;

layout(location = 0) in vec3 in_a[];
layout(location = 1) in vec3 in_ab[];
layout(location = 2) in vec3 in_ac[];
layout(location = 3) flat in uvec4 in_number[];
layout(location = 0) patch out vec3 out_a;
layout(location = 1) patch out vec3 out_ab;
layout(location = 2) patch out vec3 out_ac;
layout(location = 3) patch out uvec4 out_points;   // this patch's; of them before; seed; map of the triangle's first one
layout(location = 4) patch out vec2 out_lattice;   // lines, points on each
#ifdef ALPHA_TEST
layout(location = 4) in vec3 in_alpha[];
layout(location = 5) flat in float in_cutoff[];
layout(location = 5) patch out vec4 out_alpha;  // w: cutoff
#ifdef BASE_COLOR_TEXTURE
layout(location = 6) in vec4 in_uv_ab[];
layout(location = 7) in vec2 in_uv_c[];
layout(location = 6) patch out vec4 out_uv_ab;
layout(location = 7) patch out vec2 out_uv_c;
#endif
#endif

void main() {
    uvec4 number = in_number[0];
    PatchPoints p = patch_points(number.x, number.y, 0.5 * length(cross(in_ab[0], in_ac[0])) * spread.x, spread.y);
    uint before = number.z * uint(PATCH_POINTS);
    uint count = number.w == 1u && p.count > before ? min(p.count - before, uint(PATCH_POINTS)) : 0u;
    uint lines = (count + uint(PATCH_LINE_POINTS) - 1u) / uint(PATCH_LINE_POINTS);
    // A line has two points at least.
    uint points = max((count + lines - 1u) / max(lines, 1u), 2u);
    out_a = in_a[0];
    out_ab = in_ab[0];
    out_ac = in_ac[0];
    out_points = uvec4(count, before, p.seed, p.first_map);
    out_lattice = vec2(lines, points);
#ifdef ALPHA_TEST
    out_alpha = vec4(in_alpha[0], in_cutoff[0]);
#ifdef BASE_COLOR_TEXTURE
    out_uv_ab = in_uv_ab[0];
    out_uv_c = in_uv_c[0];
#endif
#endif
    gl_TessLevelOuter[0] = float(lines);  // 0: the patch is dropped
    gl_TessLevelOuter[1] = float(points - 1u);
}
