// SPDX-License-Identifier: Apache-2.0
//
// The share of a light with a size that each pixel sees, from summed-area tables of one map (lib/convolution.glsl). The
// mean depth of what may hide the light gives the penumbra's width by similar triangles (Fernando 2005, "Percentage-Closer
// Soft Shadows"); the comparison is then filtered over that width.
#define READ_GBUFFER
#include "lib/gbuffer.glsl"
#include "lib/light.glsl"
#include "lib/convolution.glsl"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(binding = TEX_SHADOW) uniform sampler2DArray sums;
layout(std140, binding = UBO_SHADOW_VIEWS) uniform ShadowViewBlock {
    ShadowViews shadow_views;
};
layout(std430, binding = SSBO_DEPTH_RANGE) readonly buffer RangeBlock {
    uvec2 range_bits;
};
layout(binding = IMG_OUT, rg32f) writeonly uniform image2D share_image;

// A square with the area of a disk of radius 1 has this half side.
const float SQUARED_DISK = sqrt(PI) / 2.0;

// Below this the hidden part is what the series rings.
const float LEAST_HIDDEN = 0.01;

// Each looks only as wide as the one before found the penumbra to be. More of them darken umbrae and tear penumbrae.
const int SEARCHES = 3;

// A blocker so near its receiver that the series hardly tells them apart hides by at least this; below, noise would be
// taken for shadows.
const float LEAST_RESPONSE = 0.2;

// Filters have at least this half side, texels: narrower ones would show the texels.
const float LEAST_REACH = 1.0;

// Of a map, texels: corners between them.
struct Part {
    vec2 low;
    vec2 high;
};

vec4 corner(ivec2 at, int layer) {
    return texelFetch(sums, ivec3(at, layer), 0);
}

// Between corners sums grow linearly along both axes. Not the texture unit's filter, whose weights have 8 bits.
vec4 corner_between(vec2 at, int layer) {
    ivec2 i = min(ivec2(at), textureSize(sums, 0).xy - 2);
    vec2 f = at - vec2(i);
    return mix(mix(corner(i, layer), corner(i + ivec2(1, 0), layer), f.x),
               mix(corner(i + ivec2(0, 1), layer), corner(i + ivec2(1, 1), layer), f.x), f.y);
}

vec4 mean(Part p, int layer) {
    vec4 sum = corner_between(p.high, layer) - corner_between(vec2(p.low.x, p.high.y), layer) -
               corner_between(vec2(p.high.x, p.low.y), layer) + corner_between(p.low, layer);
    vec2 side = p.high - p.low;
    return sum / (side.x * side.y);
}

Part part(vec2 at, vec2 reach, float size) {
    vec2 low = clamp(at - reach, vec2(0.0), vec2(size - 1.0));
    return Part(low, clamp(at + reach, low + 1.0, vec2(size)));
}

// Half sides of the light along the map's axes: render units, or of a sun tangents.
vec2 light_reach(int face) {
#if SOFT_KIND == MAP_ORTHOGRAPHIC
    return vec2(light.cone.w) * SQUARED_DISK;
#elif PROFILE == PROFILE_AREA
    vec2 half_sides = light.area.xy * (light.map.w > 0.5 ? SQUARED_DISK : 1.0);
    // A cube's faces to the light's sides see it from its edge.
    return face < 2 ? vec2(half_sides.y, 0.0) : face < 4 ? vec2(0.0, half_sides.x) : half_sides;
#else
    return vec2(sqrt(light.intensity.w) * SQUARED_DISK);
#endif
}

// How much nearer the light, in depths of the map, what hides it is than the receiver; 0 where nothing does. reach: of the
// part of the map that tells, texels.
float separation(vec2 at, vec2 reach, float size, float depth, int first) {
    Part search = part(at, reach, size);
    float lit = 0.5;
    float lit_depth = 0.5 * mean(search, first + 2 * SERIES_LAYERS).x;
    float depth_sum = 2.0 * lit_depth;
    for (int i = 0; i < SERIES_LAYERS; ++i) {
        vec4 compare = comparison(i, depth);
        lit += dot(compare, mean(search, first + i));
        lit_depth += dot(compare, mean(search, first + SERIES_LAYERS + i));
    }
    // The series is one half where depths are equal, as on the receiver's own surface, and there as much above as below it
    // where the surface is slanted. So of a surface whose part p is hidden by what is x nearer it sees
    // (1 - p) / 2 + p (1 - r(x)) / 2, r being response(), and the same with depths; x (1 + r) / (2 r) is what follows.
    float hidden = 1.0 - 2.0 * lit;
    float apart = 0.0;
    if (hidden > LEAST_HIDDEN) {
        float found = clamp((lit_depth + lit * depth - depth_sum) / hidden + depth, 0.0, 2.0);
        apart = min(found, depth);
        for (int i = 0; i < 4; ++i) {
            float r = max(response(apart), 0.0);
            apart = min(found * 2.0 * r / (1.0 + r), depth);
        }
    }
    return apart;
}

float visible_share(vec3 position) {
    GpuShadowView view = shadow_views.view[0];
    vec2 range = uintBitsToFloat(range_bits);
    vec3 p = position - view.origin.xyz;
    float size = view.forward.w;
    int face = 0;
    vec2 st;
    float distance;
#if SOFT_KIND == MAP_CUBE
    cube_face(light_vector_from_render(p), face, st, distance);
    vec2 texels = vec2(0.5 * size);  // a unit of the map's plane at distance 1
#else
    st = vec2(dot(p, view.to_s.xyz), dot(p, view.to_t.xyz));
    distance = dot(p, view.to_depth.xyz);
    vec2 texels = 0.5 * size / vec2(length(view.right.xyz), length(view.up.xyz));
#endif
#if SOFT_KIND == MAP_PERSPECTIVE
    st /= max(distance, 1e-30);
#endif
    // Nothing is in the map, or nothing before the receiver.
    if (range_bits.x > range_bits.y || distance <= range.x) {
        return 1.0;
    }
    vec2 at = clamp((st * 0.5 + 0.5) * size, 0.0, size);
    vec2 reach = light_reach(face == 4 || face == 5 || SOFT_KIND != MAP_CUBE ? 4 : face) * texels;
#if SOFT_KIND == MAP_ORTHOGRAPHIC
#define FILTER_REACH(blocker) reach * (distance - (blocker))
#else
#define FILTER_REACH(blocker) reach * (1.0 / max(blocker, 1e-20) - 1.0 / distance)
#endif
    float depth = unit_depth(distance, range);
    int first = face * BASIS_LAYERS;
    float apart = depth;  // of the nearest that the map holds: what may hide the light lies within that reach
    for (int search = 0; search < SEARCHES; ++search) {
        apart = separation(at, max(FILTER_REACH(distance_of(depth - apart, range)), LEAST_REACH), size, depth, first);
    }
    vec2 wide = FILTER_REACH(distance_of(depth - apart, range));
    Part filtered = part(at, max(wide, LEAST_REACH), size);
    float hidden = 0.0;
    for (int i = 0; i < SERIES_LAYERS; ++i) {
        hidden -= 2.0 * dot(comparison(i, depth), mean(filtered, first + i));
    }
    return clamp(1.0 - hidden / clamp(response(apart), LEAST_RESPONSE, 1.2), 0.0, 1.0);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, frame.size.xy))) {
        return;
    }
    Surface s;
    float depth = read_surface_unbranched(pixel, s);
    float share = depth > 0.0 ? visible_share(s.position) : 1.0;
    imageStore(share_image, pixel, vec4(share, 1.0, 0.0, 0.0));
}
