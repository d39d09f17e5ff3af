// SPDX-License-Identifier: Apache-2.0
//
// Indirect light from one light's RSM (Dachsbacher and Stamminger 2005, eq. 1 to 3).
//
// Eq. 1 with the factor that turns irradiance into the diffuse reflection of what the paper calls flux: a
// texel that reflects flux F diffusely has radiant intensity F/pi cos. Summing over texels is an integral
// over the map; a sample pattern estimates it, each sample standing for an area of the map:
//
// - The pattern holds points of the unit disk (angle, radius xi) and the disk area each stands for. The
//   density falls with the squared distance from the middle, so that area grows with xi^2 (eq. 3).
// - The disk is laid onto the map around the receiver's own projection c, stretched so that its rim is the
//   rim of the map: no sample falls outside and the areas sum up to the map's, for every receiver. (The
//   paper's fixed r_max loses what lies beyond it, or samples beyond the map.)
//   A direction with distance R from c to the rim stretches areas by R^2.
// - A cube map is the sphere of directions: the disk is its equal-area map around the receiver's direction.
//
// Mode: FULL every pixel, LOW_RESOLUTION one pixel in step x step, LIST the pixels that could not be
// interpolated. FULL_SUM takes every texel instead of the pattern: the reference.
#define READ_GBUFFER
#define READ_RSM
#include "lib/gbuffer.glsl"
#include "lib/rsm.glsl"

#ifdef LIST
layout(local_size_x = GROUP_1D) in;
layout(std430, binding = SSBO_PIXEL_LIST) readonly buffer PixelListBlock {
    uint pixel_list[];
};
layout(std430, binding = SSBO_DISPATCH) readonly buffer DispatchBlock {
    uvec4 dispatch;  // groups in x, 1, 1, pixels
};
#else
layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
#endif

layout(std430, binding = SSBO_PATTERN) readonly buffer PatternBlock {
    vec4 pattern[];  // cos and sin of the angle, radius xi, area (all areas sum to pi)
};
layout(binding = IMG_OUT, rgba32f) uniform image2D irradiance_image;
#ifdef FULL_SUM
// Layer, first row, row after the last: the sum is cut into dispatches that no driver takes for a hang
// (Mesa's llvmpipe ends every loop after 65,535 iterations in all).
layout(location = 0) uniform ivec3 full_sum_rows;
#endif

// Irradiance (times Disney's factors) at s from the pixel light at st, where the sample stands for
// `measure`: solid angle from the light, or area across a sun's rays.
vec3 pixel_light_irradiance(Surface s, vec3 v, vec2 st, int layer, float measure) {
    PixelLight p;
    if (!read_pixel_light(st, layer, p)) {
        return vec3(0.0);
    }
    vec3 d = s.position - p.position;
    float cos_p = dot(p.normal, d);
    float cos_s = -dot(s.normal, d);
    if (cos_p <= 0.0 || cos_s <= 0.0) {
        return vec3(0.0);
    }
    float squared = dot(d, d);
    // The sample stands for a piece of surface, not a point: at a distance small against that piece 1/d^2
    // overshoots. A disk of the piece's area A, seen along its axis, gives exactly 1/(d^2 + A/pi). Seen from
    // the side it does not: the mean of the kernel over a small disk differs from its middle by the share
    // 3/8 (5 sin^2 - 2) A/(pi d^2), which vanishes 39 degrees off the axis. The bound therefore fades with
    // cos^2; it still keeps every sample finite, because a receiver in the piece's own plane gets nothing.
    // cos_incident is bounded because a grazing map texel says little about how far its surface goes on.
    float cos_incident = -dot(p.normal, p.from_light);
    // Samples of the other places of a light lie on the same surface.
    float piece = measure * p.squared_distance / max(cos_incident, 0.1) * light.cone.z;
    float geometry = cos_p * cos_s / (squared * squared + cos_p * cos_p * piece / PI);
#ifdef DISNEY
    vec3 to_receiver = d * inversesqrt(squared);
    if (p.disney) {
        geometry *= disney_diffuse_factor(max(cos_incident, 0.0), dot(p.normal, to_receiver),
                                          -dot(p.from_light, to_receiver), p.roughness);
    }
    if (s.disney) {
        geometry *= disney_diffuse_factor(dot(s.normal, -to_receiver), dot(s.normal, v), dot(-to_receiver, v),
                                          s.roughness);
    }
#endif
    return p.color * ((1.0 - p.metallic) * geometry * measure / PI);
}

#if MAP_KIND != MAP_CUBE
// Distance from c along the unit direction d to the rim of the map: the circle around a spot's cone, the
// square of a sun's map.
float distance_to_rim(vec2 c, vec2 d) {
#if MAP_KIND == MAP_PERSPECTIVE
    float b = dot(c, d);
    return -b + sqrt(max(b * b - dot(c, c) + 1.0, 0.0));
#else
    vec2 t = (sign(d) - c) / vec2(d.x == 0.0 ? 1e-9 : d.x, d.y == 0.0 ? 1e-9 : d.y);
    return max(min(d.x == 0.0 ? 1e9 : t.x, d.y == 0.0 ? 1e9 : t.y), 0.0);
#endif
}

// How far from the map's middle the pattern may be centred. A receiver that lies outside the map would
// centre it on the rim, where half the directions have no room and their samples stand for nothing. On
// examples/cornell.py at 64x36, against the full sum, 0.6 had seven tenths of the relMSE of 0.98 at 112 and at
// 448 samples; 0.4 and 0.8 lay between.
const float FARTHEST_CENTER = 0.6;

// Where the receiver lies in the map, moved inside its rim.
vec2 center_in_map(vec3 position) {
    vec3 p = light_from_render(position);
#if MAP_KIND == MAP_PERSPECTIVE
    // Behind the light the projection turns over; its direction from the axis still tells the near side.
    vec2 c = p.xy / (max(p.z, 1e-3 * length(p)) * light.axis.w + 1e-30);
    float r = length(c);
    return r > FARTHEST_CENTER ? c * (FARTHEST_CENTER / r) : c;
#else
    return clamp(p.xy / vec2(light.tangent.w, light.bitangent.w), -FARTHEST_CENTER, FARTHEST_CENTER);
#endif
}

#endif

vec3 gather(Surface s, vec3 v) {
    vec3 sum = vec3(0.0);
#if defined(FULL_SUM)
    int size = int(light.map.x);
    float texel = 2.0 / light.map.x;
    for (int y = full_sum_rows.y; y < full_sum_rows.z; ++y) {
        vec3 row = vec3(0.0);  // rows apart: a float sum over every texel would lose digits
        for (int x = 0; x < size; ++x) {
            vec2 st = (vec2(x, y) + 0.5) * texel - 1.0;
            row += pixel_light_irradiance(s, v, st, full_sum_rows.x, map_measure(st, texel * texel));
        }
        sum += row;
    }
#elif MAP_KIND == MAP_CUBE
    vec3 axis = safe_normalize(light_from_render(s.position), vec3(0.0, 0.0, 1.0));
    vec3 t;
    vec3 b;
    orthonormal_basis(axis, t, b);
    for (int i = 0; i < frame.size.w; ++i) {
        vec4 sample_point = pattern[i];
        float r = sample_point.z;  // sin of half the angle from the axis: an equal-area map
        float along = 1.0 - 2.0 * r * r;
        float across = 2.0 * r * sqrt(max(1.0 - r * r, 0.0));
        vec3 direction = axis * along + (t * sample_point.x + b * sample_point.y) * across;
        int face;
        vec2 st;
        float depth;
        cube_face(direction, face, st, depth);
        sum += pixel_light_irradiance(s, v, st, face, 4.0 * sample_point.w);
    }
#else
    vec2 c = center_in_map(s.position);
    for (int i = 0; i < frame.size.w; ++i) {
        vec4 sample_point = pattern[i];
        float rim = distance_to_rim(c, sample_point.xy);
        vec2 st = c + sample_point.xy * (sample_point.z * rim);
        sum += pixel_light_irradiance(s, v, st, 0, map_measure(st, sample_point.w * rim * rim));
    }
#endif
    return light.intensity.rgb * sum;
}

void main() {
#ifdef LIST
    uint index = gl_GlobalInvocationID.x;
    if (index >= dispatch.w) {
        return;
    }
    uint place = pixel_list[index];
    ivec2 pixel = ivec2(place & 0xffffu, place >> 16);
    ivec2 target = pixel;
#elif defined(LOW_RESOLUTION)
    ivec2 target = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(target, imageSize(irradiance_image)))) {
        return;
    }
    ivec2 pixel = min(target * frame.size.z + frame.size.z / 2, frame.size.xy - 1);
#else
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, frame.size.xy))) {
        return;
    }
    ivec2 target = pixel;
#endif
    vec3 irradiance = vec3(0.0);
#ifndef FIRST_LIGHT
    irradiance = imageLoad(irradiance_image, target).rgb;
#endif
    Surface s;
    if (read_surface(pixel, s)) {
        irradiance += gather(s, direction_to_viewer(s.position));
    }
#ifdef LIST
    const float interpolated = 0.0;  // the interpolation view shows these
#else
    const float interpolated = 1.0;
#endif
    imageStore(irradiance_image, target, vec4(irradiance, interpolated));
}
