// SPDX-License-Identifier: Apache-2.0
//
// A point of a patch: which of them it is, is all that is taken from the tessellator, whose own places are denser along
// the triangle's sides. Its map and its place follow from that number; then it is drawn as points that are stored are
// (passes/ism_points.vert).
#include "lib/patch.glsl"
#include "lib/splat.glsl"

layout(isolines, equal_spacing, point_mode) in;
layout(location = 0) uniform vec2 atlas_size;
layout(location = 0) patch in vec3 in_a;
layout(location = 1) patch in vec3 in_ab;
layout(location = 2) patch in vec3 in_ac;
layout(location = 3) patch in uvec4 in_points;
layout(location = 4) patch in vec2 in_lattice;
#ifdef ALPHA_TEST
layout(location = 5) patch in vec4 in_alpha;
#ifdef BASE_COLOR_TEXTURE
layout(location = 6) patch in vec4 in_uv_ab;
layout(location = 7) patch in vec2 in_uv_c;
layout(binding = TEX_BASE_COLOR) uniform sampler2D base_color_texture;
#endif
#endif
layout(location = 0) flat out ivec2 out_origin;

#ifdef ALPHA_TEST
// As scene::drop_cut_out() leaves out stored points: of a blended surface a part alpha of them stays.
bool is_cut_out(vec2 at, uint seed) {
    vec3 weights = vec3(1.0 - at.x - at.y, at);
    float alpha = dot(in_alpha.xyz, weights);
#ifdef BASE_COLOR_TEXTURE
    vec2 uv = weights.x * in_uv_ab.xy + weights.y * in_uv_ab.zw + weights.z * in_uv_c;
    alpha *= textureLod(base_color_texture, uv, 0.0).a;
#endif
#ifdef BLENDED
    float cutoff = (float(patch_hash(seed + 0x51ED270Bu) >> 8u) + 0.5) / 16777216.0;
#else
    float cutoff = in_alpha.w;
#endif
    return alpha < cutoff;
}
#endif

void main() {
    uint line = uint(round(gl_TessCoord.y * in_lattice.x));
    uint along = uint(round(gl_TessCoord.x * (in_lattice.y - 1.0)));
    uint number = line * uint(in_lattice.y) + along;
    bool drawn = number < in_points.x;
    number += in_points.y;
    uint maps = uint(ism.atlas.z);
    uint map = (in_points.w + number) % maps;
    vec2 at = place_on_triangle(in_points.z, map, number / maps);

    vec3 across = cross(in_ab, in_ac);
    SurfacePoint p;
    p.position = in_a + at.x * in_ab + at.y * in_ac;
    p.normal = across / max(length(across), 1e-30);
    p.radius = sqrt(spread.z);
    p.flat_surface = false;
#ifdef ALPHA_TEST
    drawn = drawn && !is_cut_out(at, in_points.z ^ number);
#endif
    Splat s;
    bool seen = see_surface_point(vpls[map], p, float(ism.atlas.x), s);
    out_origin = ism_origin(int(map));
    // Depth 1 at the light, 0 at infinity.
    gl_Position = drawn && seen ? vec4((vec2(out_origin) + s.place) / atlas_size * 2.0 - 1.0, 1.0 / (1.0 + s.distance), 1.0)
                                : vec4(0.0, 0.0, -1.0, 1.0);
    gl_PointSize = max(2.0 * s.half_side, 1.0);
}
