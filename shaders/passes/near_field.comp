// SPDX-License-Identifier: Apache-2.0
//
// The part of bounced light that comes from so near that single virtual point lights would show: gathered from one
// light's reflective shadow map around the receiver's own place in it (after Dachsbacher and Stamminger 2005, eq.
// 3), weighed by near_share(), which the far gather leaves out.
//
// Samples lie on a spiral whose radii fall by a constant factor, so that every octave of distance down to contact
// has its samples and none of them weighs too much: the area a sample stands for grows as 1/d^2 falls. Pixels of an
// n x n block turn and scale the spiral, so that together they have n x n times the samples; the blur averages them.
#define READ_GBUFFER
#define READ_RSM_IMAGE
#include "lib/gbuffer.glsl"
#include "lib/vpl.glsl"
#include "lib/vpl_importance.glsl"
#include "lib/vpl_make.glsl"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(location = 0) uniform int rows;    // rows of all maps together
layout(location = 1) uniform ivec2 round_;  // which of how many sets of samples this is
layout(location = 2) uniform vec3 turns;    // by how much samples are turned, parts of the step and of the circle; extent of
                                            // a light, as in passes/vpl_draw.comp
layout(location = 3) uniform vec2 even;     // texels that a light stands for where that is the same everywhere, and the part
                                            // of that in the mean with what follows from their importance
layout(binding = IMG_OUT, rgba32ui) uniform uimage2D bounced_image;
layout(std430, binding = SSBO_PIXEL_LIST) readonly buffer TileBlock {
    uvec2 tiles[];
};
layout(std430, binding = SSBO_NEAR_COUNT) readonly buffer DispatchBlock {
    uvec3 groups;
    uint tile_count;
};
layout(std430, binding = SSBO_ROW_SUMS) readonly buffer RowBlock {
    float running_sums[];
};

// From its rim to its innermost sample the spiral spans this factor.
const float SPAN = 256.0;  // down to about a texel of a map of 256 at the widest
// Lobes need more samples than cosines do.
#ifdef GLOSSY
#define SAMPLES NEAR_SAMPLES_GLOSSY
#else
#define SAMPLES NEAR_SAMPLES
#endif
const float LOG_STEP = log(SPAN) / float(SAMPLES);
const float GOLDEN_ANGLE = 2.39996322972865;

// Point of the spiral inside the unit disk; an integer's place is a constant.
vec2 spiral(int i) {
    float angle = GOLDEN_ANGLE * float(i);
    return exp(-LOG_STEP * float(i)) * vec2(cos(angle), sin(angle));
}

// As WIDENING, for a sample: the blur averages the samples of a block of pixels, so each needs to fill less of the gaps
// between them. None leaves fireflies, much more darkens reflections near contact; docs/papers/imperfect_shadow_maps.md
// has the measurement.
const float NEAR_WIDENING = WIDENING / 8.0;

struct Center {
    Surface s;
    Receiver r;
    float importance_a_vpl;  // of the texels that a virtual point light stands for
};

// What the map has at st (-1 to 1) of a layer, where it stands for `measure` of the map.
// radius: how far the sample lies from the receiver across the light's rays.
void add_sample(Center at, vec2 st, int layer, float measure, float radius, inout BouncedLight sum) {
    ivec2 texel = ivec2(clamp((st * 0.5 + 0.5) * light.map.x, vec2(0.0), vec2(light.map.x - 1.0)));
    PixelLight p;
    float seen = decode_pixel_light(load_rsm(texel, layer), texel, layer, p) ? 1.0 : 0.0;
    vec3 d = at.s.position - p.position;
    vec3 w = d * inversesqrt(max(dot(d, d), 1e-30));
    // A sample's share of the map grows with its own distance; if its texel's middle happens to be much nearer to the
    // receiver, the two do not belong together.
    float squared = max(max(dot(d, d), 0.5 * radius * radius), 1e-30);
    float inverse = inversesqrt(squared);
    float cos_out = max(dot(p.normal, w), 0.0);
    float cos_in = max(-dot(at.s.normal, w), 0.0);
    // What a light there stands for of the map.
#ifdef IMPORTANCE_MAP
    float by_importance = at.importance_a_vpl / max(texel_importance(texel, layer), 1e-30);
    float standing = mix(by_importance, even.x, even.y) * texel_measure(texel, p);
#else
    // texel_importance / texel_measure: the flux a unit of the map reflects.
    float standing = even.y > 0.0 ? even.x * texel_measure(texel, p)
                                  : at.importance_a_vpl / max(importance_density(p.color, p.metallic, p.arriving), 1e-30);
#endif
    float area = surface_area(p, standing) * light.cone.z * turns.z;  // as in passes/vpl_draw.comp
    float share = near_share(squared, 1.0 / max(NEAR_RADIUS * NEAR_RADIUS * area, 1e-30));
    float widening = NEAR_WIDENING * surface_area(p, measure) * cos_out * inverse * inverse;
    add_vpl(make_vpl(p, measure), at.r, w, cos_out, cos_in, seen * share * cos_out * cos_in * inverse * inverse,
            widening, sum);
}

void main() {
    uint place = gl_WorkGroupID.y * uint(MOST_GROUPS) + gl_WorkGroupID.x;
    if (place >= tile_count) {
        return;  // the group as a whole
    }
    uvec2 tile = tiles[place];
    ivec2 pixel = ivec2(tile.x & 0xffffu, tile.x >> 16) * GROUP_2D + ivec2(gl_LocalInvocationID.xy);
    // Samples know the area they stand for themselves, and it may be somewhat larger than that of the light next to them.
    float reach = uintBitsToFloat(tile.y) * 1.2;
    Center at;
    float depth = read_surface_unbranched(min(pixel, frame.size.xy - 1), at.s);
    at.r = make_receiver(at.s, direction_to_viewer(at.s.position));
    at.importance_a_vpl = running_sums[rows - 1] / float(ism.atlas.z);
    BouncedLight sum;
    sum.irradiance = vec3(0.0);
    sum.glossy = vec3(0.0);
    int n = ism.gather.x;
    float places = float(n * n * round_.y);
    float turn = float((pixel.x % n + pixel.y % n * n) * round_.y + round_.x) / places;
    // A step of the spiral's radius is shared out among the pixels of a block.
    turn = fract(turn + turns.x);
    float grow = exp(-LOG_STEP * turn);
    float angle = 2.0 * PI * fract(turn * 0.754877666 * places + turns.y);
    vec2 rotate = grow * vec2(cos(angle), sin(angle));
    // Area of the unit disk that a sample at radius 1 stands for: radii are uniform in their logarithm.
    const float ring = 2.0 * PI * LOG_STEP;
    vec3 p = light_from_render(at.s.position);
#if MAP_KIND == MAP_CUBE
    float len = max(length(p), 1e-20);
    vec3 axis = p / len;
    vec3 t;
    vec3 b;
    orthonormal_basis(axis, t, b);
    float widest = min(0.5 * reach / len, 1.0);  // sine of half the angle: the disk is an equal-area map
#define SAMPLE_MAP(i, u)                                                                           \
    {                                                                                              \
        float r2 = dot(u, u) * widest * widest;                                                    \
        vec3 direction = axis * (1.0 - 2.0 * r2) + (t * u.x + b * u.y) * (2.0 * widest * sqrt(1.0 - r2)); \
        int face;                                                                                  \
        vec2 st;                                                                                   \
        float face_depth;                                                                          \
        cube_face(direction, face, st, face_depth);                                                \
        add_sample(at, st, face, 4.0 * ring * r2, reach * length(u), sum);                         \
    }
#else
#if MAP_KIND == MAP_PERSPECTIVE
    float scale = 1.0 / max(p.z * light.axis.w, 1e-6);
    vec2 c = p.xy * scale;
    vec2 widest = vec2(reach * scale);
#else
    vec2 c = p.xy / vec2(light.tangent.w, light.bitangent.w);
    vec2 widest = reach / vec2(light.tangent.w, light.bitangent.w);
#endif
#define SAMPLE_MAP(i, u)                                                                                \
    {                                                                                                   \
        vec2 st = c + u * widest;                                                                       \
        float inside = max(abs(st.x), abs(st.y)) < 1.0 ? 1.0 : 0.0;                                     \
        float measure = map_measure(st, ring * dot(u, u) * widest.x * widest.y);                        \
        add_sample(at, st, 0, inside * measure, reach * length(u), sum);                                \
    }
#endif
    // Written out, so that the spiral's points are constants.
#define NEAR(i)                                                                                    \
    {                                                                                              \
        vec2 q = spiral(i);                                                                        \
        vec2 u = vec2(q.x * rotate.x - q.y * rotate.y, q.x * rotate.y + q.y * rotate.x);           \
        SAMPLE_MAP(i, u)                                                                           \
    }
    NEAR(0) NEAR(1) NEAR(2) NEAR(3) NEAR(4) NEAR(5) NEAR(6) NEAR(7)
#if SAMPLES == 16
    NEAR(8) NEAR(9) NEAR(10) NEAR(11) NEAR(12) NEAR(13) NEAR(14) NEAR(15)
#endif
    if (depth == 0.0 || any(greaterThanEqual(pixel, frame.size.xy))) {
        return;
    }
    uvec4 bits = imageLoad(bounced_image, pixel);
    BouncedLight before = unpack_bounced(bits);
    float weight = frame.composite.w / float(round_.y);
    sum.irradiance = before.irradiance + sum.irradiance * weight;
    sum.glossy = before.glossy + sum.glossy * weight;
    imageStore(bounced_image, pixel, pack_bounced(sum, uintBitsToFloat(bits.w)));
}
