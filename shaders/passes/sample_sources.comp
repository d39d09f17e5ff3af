// SPDX-License-Identifier: Apache-2.0
//
// Finds for each of a pixel's depth samples the pixel around whose surface it lies on. In screen space the
// depth of a plane is linear, so each pixel foretells the depth of any sample on its plane; the sample belongs to the
// pixel that comes nearest, in widths of a pixel off the plane.
#define READ_GBUFFER
#include "lib/gbuffer.glsl"
#include "lib/sample_sources.glsl"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(location = 0) uniform vec2 places[AA_SAMPLES];  // from the pixel's middle
layout(binding = TEX_DEPTH_SAMPLES) uniform sampler2DMS depth_samples;
layout(binding = TEX_GEOMETRIC_NORMAL) uniform sampler2D geometric_normal_texture;
layout(binding = IMG_OUT, r16ui) writeonly uniform uimage2D sources_image;

// A sample this near to the pixel's own plane, in widths of a pixel, is its own without a look around: rounding, and a
// smooth mesh's next triangle.
const float OWN_TOLERANCE = 0.05;
// Another pixel must be nearer by this factor: where surfaces curve into a crease, planes of several come near by chance.
const float NEARER_BY = 0.5;
// Pixels of one plane come equally near up to rounding: of those the nearest to the sample. Widths off the plane that a
// pixel of distance counts for.
const float PER_PIXEL = 0.01;
// A sample this far from every pixel's plane is part of something that no pixel's middle shows.
const float LEAST_DISTANCE_OF_NONE = 1e20;

struct Plane {
    float depth;
    vec2 slope;      // of depth, a pixel
    float off_plane;  // how much depth changes by a pixel's width off the plane
};

Plane plane_of(ivec2 pixel) {
    Plane plane;
    plane.depth = texelFetch(depth_texture, pixel, 0).r;
    vec3 position = pixel_position(pixel, plane.depth > 0.0 ? plane.depth : 0.5);
    vec3 normal = octahedral_decode(texelFetch(geometric_normal_texture, pixel, 0).xy * 2.0 - 1.0);
    vec4 c = vec4(normal, -dot(normal, position)) * frame.render_from_clip;
    float per_depth = c.z == 0.0 ? 0.0 : 1.0 / c.z;
    plane.slope = -2.0 * c.xy * per_depth / vec2(frame.size.xy);
    plane.off_plane = abs(per_depth) * 2.0 * frame.interpolation.z;
    return plane;
}

// at: from the middle of the plane's pixel. Nothing is behind everything: only nothing is near to it.
float distance_off(Plane plane, float depth, vec2 at) {
    float off = abs(depth - (plane.depth + dot(plane.slope, at))) / max(plane.off_plane, 1e-30);
    bool nothing = plane.depth == 0.0;
    return nothing == (depth == 0.0) ? (nothing ? 0.0 : off) : LEAST_DISTANCE_OF_NONE;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, frame.size.xy))) {
        return;
    }
    Plane own = plane_of(pixel);
    float depths[AA_SAMPLES];
    float nearest[AA_SAMPLES];
    float off_own[AA_SAMPLES];
    float worst = 0.0;
    for (int s = 0; s < AA_SAMPLES; ++s) {
        depths[s] = texelFetch(depth_samples, pixel, s).r;
        off_own[s] = distance_off(own, depths[s], places[s]);
        nearest[s] = off_own[s] + PER_PIXEL * length(places[s]);
        worst = max(worst, off_own[s]);
    }
    uint sources = ALL_SELF;
    if (worst > OWN_TOLERANCE) {
        uint found[4] = uint[4](SOURCE_SELF, SOURCE_SELF, SOURCE_SELF, SOURCE_SELF);
        for (uint k = 0u; k < 9u; ++k) {
            ivec2 offset = source_offset(k);
            ivec2 other = clamp(pixel + offset, ivec2(0), frame.size.xy - 1);
            Plane plane = plane_of(other);
            for (int s = 0; s < AA_SAMPLES; ++s) {
                vec2 at = places[s] - vec2(other - pixel);
                float distance = distance_off(plane, depths[s], at);
                float score = distance + PER_PIXEL * length(at);
                if (score < nearest[s] && off_own[s] > OWN_TOLERANCE && distance < NEARER_BY * off_own[s]) {
                    nearest[s] = score;
                    found[s] = k;
                }
            }
        }
        sources = found[0] | found[1] << 4 | found[2] << 8 | found[3] << 12;
    }
    imageStore(sources_image, pixel, uvec4(sources));
}
