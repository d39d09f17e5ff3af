// SPDX-License-Identifier: Apache-2.0
//
// Bounced light as a mean over frames (passes/temporal_reuse.h). BEFORE: there is a frame before, and what it kept is
// taken where it saw the same place. MOVED: draws moved, so that the place is looked up in vectors of motion, which tell
// what was hidden as well; else it follows from the cameras alone. Without BEFORE the light is kept as it is.
#define READ_GBUFFER
#include "lib/bounced.glsl"
#include "lib/gbuffer.glsl"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(binding = IMG_OUT, rgba32ui) writeonly uniform uimage2D kept_image;
layout(binding = IMG_OUT1, r8ui) writeonly uniform uimage2D frames_image;
layout(binding = IMG_IN, rgba32ui) readonly uniform uimage2D bounced_image;
layout(binding = TEX_GEOMETRIC_NORMAL) uniform sampler2D geometric_normal_texture;
#ifdef COUNT
layout(std430, binding = SSBO_REUSE_COUNT) buffer CountBlock { uint surfaces; uint reused; };
#endif
#ifdef BEFORE
layout(location = 0) uniform vec4 reuse;  // frames of a mean at most, scale of light now over then, 1 / interleave, -
layout(std140, binding = UBO_MOTION) uniform MotionBlock { MotionUniforms motion; };
layout(binding = IMG_HISTORY, rgba32ui) readonly uniform uimage2D before_image;
layout(binding = IMG_HISTORY_LENGTH, r8ui) readonly uniform uimage2D before_frames_image;
layout(binding = TEX_HISTORY_NORMAL) uniform sampler2D before_normal_texture;
layout(binding = TEX_LOWRES) uniform sampler2D spread_texture;
#ifdef MOVED
layout(binding = TEX_MOTION) uniform sampler2D motion_texture;
#endif

// What lies this many pixels' widths off the surface's plane is another surface, and what is turned from it by more than
// 25 degrees as well.
const float SAME_SURFACE = 2.0;
const float SAME_NORMAL = 0.9;
// Neighbours that count for less are left out.
const float LEAST_WEIGHT = 0.01;
// The mean of a block's pixels is off by its spread over n in the mean square where each pixel's lights are chosen anew.
// So the frame before may differ by two of these, or by one where draws moved and their shadows with them; what differs
// by more is cut to that, and what differs by twice as much is another light, whose mean begins again. Where nothing moved but the camera irradiance is what it was, and only what
// was taken for the same place and is not has to be caught: a clip that noise never meets lets a mean grow long.
#ifdef MOVED
const float SPREADS = 1.0;
const float IRRADIANCE_SPREADS = SPREADS;
#else
const float SPREADS = 2.0;
const float IRRADIANCE_SPREADS = 4.0 * SPREADS;
#endif
// Glossy light is another one from each place of the camera.
const float MOST_GLOSSY_FRAMES = 16.0;

struct Before {
    BouncedLight light;
    float frames;  // 0: nothing is known of the place
};

#ifdef MOVED
// Where a pixel's point of surface was, in pixels; false where it was not seen. The vectors were tested against the
// depths of then.
bool place_before(ivec2 pixel, vec3 position, out vec2 then) {
    vec3 way = texelFetch(motion_texture, pixel, 0).xyz;
    then = vec2(pixel) + 0.5 + vec2(way.x, -way.y);
    return way.z > 0.0;
}

bool same_place(vec3 position, vec3 normal, ivec2 place, float depth) {
    return true;
}
#else
bool place_before(ivec2 pixel, vec3 position, out vec2 then) {
    vec4 clip = motion.clip_from_render * vec4(position, 1.0);
    then = (clip.xy / (clip.w > 0.0 ? clip.w : 1.0) * 0.5 + 0.5) * motion.picture.xy;
    return clip.w > 0.0;
}

bool same_place(vec3 position, vec3 normal, ivec2 place, float depth) {
    vec4 p = motion.render_from_clip * vec4((vec2(place) + 0.5) / motion.picture.xy * 2.0 - 1.0, depth, 1.0);
    float distance = dot(position - motion.eye.xyz, motion.forward.xyz);
    float width = motion.forward.w * (motion.picture.z > 0.5 ? distance : 1.0);
    return abs(dot(p.xyz / p.w - position, normal)) <= SAME_SURFACE * width;
}
#endif

Before light_before(ivec2 pixel, vec3 position, vec3 normal) {
    Before b;
    b.light.irradiance = b.light.glossy = vec3(0.0);
    b.frames = 0.0;
    vec2 then;
    bool placed = place_before(pixel, position, then);
    // Rounding must not blur what stands still.
    vec2 place = floor((then - 0.5) * 256.0 + 0.5) / 256.0;
    vec2 corner = floor(place);
    vec2 part = place - corner;
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        vec2 share = mix(1.0 - part, part, vec2(offset));
        float weight = share.x * share.y;
        ivec2 tap = ivec2(clamp(corner, vec2(-2.0), vec2(frame.size.xy) + 2.0)) + offset;
        bool inside = placed && all(greaterThanEqual(tap, ivec2(0))) && all(lessThan(tap, frame.size.xy));
        tap = clamp(tap, ivec2(0), frame.size.xy - 1);
        uvec4 bits = imageLoad(before_image, tap);
        float depth = uintBitsToFloat(bits.w);
        vec3 normal_then = octahedral_decode(texelFetch(before_normal_texture, tap, 0).xy * 2.0 - 1.0);
        bool same = inside && weight >= LEAST_WEIGHT && depth > 0.0 && abs(dot(normal_then, normal)) > SAME_NORMAL &&
                    same_place(position, normal, tap, depth);
        weight = same ? weight : 0.0;
        BouncedLight light = unpack_bounced(bits);
        b.light.irradiance += weight * light.irradiance;
        b.light.glossy += weight * light.glossy;
        b.frames += weight * float(imageLoad(before_frames_image, tap).r);
        weights += weight;
    }
    if (weights > 0.0) {
        b.light.irradiance *= reuse.y / weights;
        b.light.glossy *= reuse.y / weights;
        b.frames = max(b.frames / weights, 1.0);
    }
    return b;
}

// The light of `frames` frames, pulled towards this frame's until it is no farther off than `most`, with this frame's
// taken into the mean. Out: how many frames it is of then.
vec3 mean_with(vec3 light, vec3 now, vec3 most, inout float frames) {
    // What halves between gather and here round is no difference.
    vec3 far = abs(light - now) / max(most + now / 1024.0, vec3(1e-6));
    frames = max(max(far.r, far.g), far.b) > 2.0 ? 1.0 : frames + 1.0;
    vec3 near = clamp(light, now - most, now + most);
    return near + (now - near) / frames;
}
#endif

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 last = frame.size.xy - 1;
    uvec4 bits = imageLoad(bounced_image, min(pixel, last));
    float depth = uintBitsToFloat(bits.w);
    BouncedLight light = unpack_bounced(bits);
    float frames = depth > 0.0 ? 1.0 : 0.0;
    bool taken = false;
#ifdef BEFORE
    vec3 position = pixel_position(min(pixel, last), depth > 0.0 ? depth : 0.5);
    vec3 normal = octahedral_decode(texelFetch(geometric_normal_texture, min(pixel, last), 0).xy * 2.0 - 1.0);
    Before before = light_before(min(pixel, last), position, normal);
    vec4 spread = texelFetch(spread_texture, min(pixel, last) / BLOCK, 0) * reuse.z;
    taken = depth > 0.0 && before.frames > 0.0;
    if (taken) {
        frames = min(before.frames, reuse.x - 1.0);
        float glossy_frames = min(frames, MOST_GLOSSY_FRAMES - 1.0);
        light.irradiance =
            mean_with(before.light.irradiance, light.irradiance, IRRADIANCE_SPREADS * spread.rgb, frames);
        light.glossy = mean_with(before.light.glossy, light.glossy, vec3(SPREADS * spread.a / 3.0), glossy_frames);
    }
#endif
    if (any(greaterThan(pixel, last))) {
        return;
    }
    imageStore(kept_image, pixel, taken ? pack_bounced(light, depth) : bits);
    imageStore(frames_image, pixel, uvec4(uint(frames + 0.5)));
#ifdef COUNT
    if (depth > 0.0) {
        atomicAdd(surfaces, 1u);
        if (taken) {
            atomicAdd(reused, 1u);
        }
    }
#endif
}
