// SPDX-License-Identifier: Apache-2.0
//
// Where the point of surface at a pixel's middle was in the frame before: the way there in pixels, to the right and
// down, and its distance along that camera's axis in metres, 0 where that frame did not show it.
#include "lib/alpha_test.glsl"
#include "shared/bindings.h"
#include "shared/types.h"

layout(std140, binding = UBO_MOTION) uniform MotionBlock {
    MotionUniforms motion;
};
layout(location = 8) in vec4 in_clip;
layout(location = 9) in vec4 in_previous_clip;
layout(location = 10) flat in uint in_drawn_before;
layout(binding = TEX_PREVIOUS_DEPTH) uniform sampler2D previous_depth;
layout(location = 0) out vec4 out_motion;

// As in previewer/image/reprojection.cpp, which leaves out neighbours that count for less.
const float LEAST_WEIGHT = 0.01;
// What lies this many pixels' widths before or behind the surface's plane is another surface: one would leave out
// curved ones, whose neighbours are not on the plane.
const float SAME_SURFACE = 2.0;
// Pixels; beyond it a point is next to the camera's plane, and its place on the picture means nothing.
const float FARTHEST = 1e6;

vec2 pixel_of(vec4 clip) {
    return (clip.xy / clip.w * 0.5 + 0.5) * motion.picture.xy;
}

// Along the axis of the camera of then, render space.
float distance_of(vec2 pixel, float depth) {
    vec4 p = motion.render_from_clip * vec4(pixel / motion.picture.xy * 2.0 - 1.0, depth, 1.0);
    return dot(p.xyz / p.w - motion.eye.xyz, motion.forward.xyz);
}

bool same_surface(vec2 pixel, float depth, float expected_depth) {
    if (!(depth > 0.0 && expected_depth > 0.0)) {  // nothing is there, or the plane goes through the camera
        return false;
    }
    float expected = distance_of(pixel, expected_depth);
    float width = motion.forward.w * (motion.picture.z > 0.5 ? expected : 1.0);
    return abs(distance_of(pixel, depth) - expected) <= SAME_SURFACE * width;
}

void main() {
    // Both by the same sums, so that what stands still moves by exactly nothing.
    vec2 now = pixel_of(in_clip);
    vec2 then = pixel_of(in_previous_clip);
    float depth = in_previous_clip.z / in_previous_clip.w;
    // Clip depth is linear over the picture of a plane: its slope there from the ones here. Before anything is
    // discarded, while the neighbours are still there.
    vec2 across = dFdx(then);
    vec2 up = dFdy(then);
    float depth_across = dFdx(depth);
    float depth_up = dFdy(depth);
    alpha_test();

    vec2 way = then - now;
    out_motion = vec4(0.0, 0.0, 0.0, 1.0);
    bool placed = in_drawn_before == 1u && in_previous_clip.w > 0.0 && depth > 0.0;
    if (!placed || !(max(abs(way.x), abs(way.y)) < FARTHEST)) {
        return;
    }
    float area = across.x * up.y - across.y * up.x;
    bool seen = abs(area) > 0.0;  // else it was seen from its edge
    vec2 slope = vec2(depth_across * up.y - depth_up * across.y, depth_up * across.x - depth_across * up.x) /
                 (seen ? area : 1.0);
    vec2 corner = floor(then - 0.5);
    vec2 part = then - 0.5 - corner;
    for (int i = 0; i < 4; ++i) {
        vec2 offset = vec2(i & 1, i >> 1);
        vec2 weight = mix(1.0 - part, part, offset);
        if (weight.x * weight.y < LEAST_WEIGHT) {
            continue;
        }
        vec2 place = corner + offset;
        if (any(lessThan(place, vec2(0.0))) || any(greaterThanEqual(place, motion.picture.xy))) {
            seen = false;
            continue;
        }
        float there = texelFetch(previous_depth, ivec2(place), 0).r;
        seen = seen && same_surface(place + 0.5, there, depth + dot(slope, place + 0.5 - then));
    }
    out_motion = vec4(way.x, now.y - then.y, seen ? distance_of(then, depth) * motion.eye.w : 0.0, 1.0);
}
