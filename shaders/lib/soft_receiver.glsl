// SPDX-License-Identifier: Apache-2.0
//
// The receiver of a soft shadow that a pixel shows; with READ_GBUFFER.
#ifndef LIB_SOFT_RECEIVER
#define LIB_SOFT_RECEIVER

#include "lib/gbuffer.glsl"
#include "lib/receiver_plane.glsl"
#include "lib/shadow.glsl"
#ifdef IMPERFECT
#include "lib/imperfect_shadow.glsl"
#else
#include "lib/soft_shadow.glsl"
#endif

// Returns the depth, 0 where the pixel shows no surface; r is then of no use, but finite.
float soft_receiver(ivec2 pixel, out SoftReceiver r) {
    Surface s;
    float depth = read_surface_unbranched(pixel, s);
    float some = depth > 0.0 ? depth : 0.5;
    vec3 v = direction_to_viewer(s.position);
    r.position = s.position;
    r.normal = s.normal;
    r.plane = geometric_normal(pixel);
    r.right = step_on_plane(s.position, r.plane, v, pixel + ivec2(1, 0), some);
    r.up = step_on_plane(s.position, r.plane, v, pixel + ivec2(0, 1), some);
    r.slack = CONTACT_SLOPE * max(length(r.right), length(r.up));
    return depth;
}

#endif
