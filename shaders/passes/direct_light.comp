// SPDX-License-Identifier: Apache-2.0
// Adds one light's direct illumination: Cycles' laws, the material's full BRDF, a hard shadow or the
// visibility that passes/soft_shadow found.
#define READ_GBUFFER
#include "lib/gbuffer.glsl"
#include "lib/light.glsl"
#ifdef LOBES
#include "lib/lobe.glsl"
#endif
#ifdef SHADOW
#include "lib/receiver_plane.glsl"
#include "lib/shadow.glsl"
#endif

// Places on a light's disk that its spot's profile is averaged over: a hard rim is drawn in steps as fine as that.
const int RIM_PLACES = 64;
const float GOLDEN_ANGLE = 2.39996323;

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(binding = IMG_OUT, rgba32f) uniform image2D direct_image;

#ifdef SOFT_SHADOW
// What passes/soft_probe.comp and soft_penumbra.comp, or convolution_shadow.comp, found out.
#ifdef TINTED
layout(binding = IMG_IN, rgba32f) readonly uniform image2D share_image;
#else
layout(binding = IMG_IN, rg32f) readonly uniform image2D share_image;
#endif
#ifdef SOFT_TILES
layout(std430, binding = SSBO_TILE_FLAGS) readonly buffer FlagBlock {
    uint flags[];
};
#endif

#ifdef TINTED
// Every tile that sees some of the light has asked all its places.
vec3 soft_visibility(ivec2 pixel) {
    ivec2 tile = pixel / GROUP_2D;
    uint seen = flags[tile.y * ((frame.size.x + GROUP_2D - 1) / GROUP_2D) + tile.x];
    vec4 share = imageLoad(share_image, pixel);
    return seen != 3u ? vec3(seen == 2u ? 0.0 : 1.0) : share.a > 0.0 ? share.rgb / share.a : vec3(1.0);
}
#else
float soft_visibility(ivec2 pixel) {
#ifndef SOFT_TILES
    return imageLoad(share_image, pixel).r;
#else
    ivec2 tile = pixel / GROUP_2D;
    uint seen = flags[tile.y * ((frame.size.x + GROUP_2D - 1) / GROUP_2D) + tile.x];
    vec2 share = imageLoad(share_image, pixel).rg;
    return seen != 3u ? (seen == 2u ? 0.0 : 1.0) : share.y > 0.0 ? share.x / share.y : 1.0;
#endif
}
#endif
#endif

// Mean cosine over a disk of directions around one with the cosine n_dot_l, where what is under the horizon counts
// nothing; tangent: of half the disk's angle. The cosine itself where the horizon does not cut the disk.
float mean_cosine(float n_dot_l, float tangent) {
#ifdef SIZED
    float slope = tangent * sqrt(max(1.0 - n_dot_l * n_dot_l, 0.0));
    if (slope <= abs(n_dot_l)) {
        return max(n_dot_l, 0.0);
    }
    // Area and first moment of the part of a unit disk beyond a chord at -a.
    float a = n_dot_l / slope;
    float root = sqrt(max(1.0 - a * a, 0.0));
    return max(n_dot_l * (acos(-a) + a * root) / PI + slope * root * root * root * (2.0 / (3.0 * PI)), 0.0);
#else
    return max(n_dot_l, 0.0);
#endif
}

// Radiance towards v for irradiance 1 W/m^2 on a plane across l, from a disk of directions around it.
vec3 reflected_diffuse(Surface s, vec3 l, vec3 v, float tangent) {
    float n_dot_l = dot(s.normal, l);
    float cosine = mean_cosine(n_dot_l, tangent);
    if (cosine <= 0.0) {
        return vec3(0.0);
    }
    float factor = 1.0;
#ifdef DISNEY
    if (s.disney) {
        factor = disney_diffuse_factor(max(n_dot_l, 0.0), dot(s.normal, v), dot(l, v), s.roughness);
    }
#endif
    return diffuse_albedo(s) * (cosine * factor / PI);
}

vec3 reflected_glossy(Surface s, vec3 l, vec3 v) {
#ifdef SPECULAR
    return specular_times_cosine(s, l, v);
#else
    return vec3(0.0);
#endif
}

#if PROFILE == PROFILE_AREA
#include "lib/area_light.glsl"
#else
vec3 reflected(Surface s, vec3 l, vec3 v, float tangent) {
    return reflected_diffuse(s, l, v, tangent) + reflected_glossy(s, l, v);
}
#endif

#if PROFILE != PROFILE_AREA && MAP_KIND != MAP_ORTHOGRAPHIC
// A profile's mean over the disk that a light with a radius shows a receiver; the middle's where it has none. It softens the
// rim of a spot's cone. Parts of an even disk count by what they send the receiver: by both cosines over the squared distance.
// l: from the receiver to the light, whose middle is `distance_` away.
float facing_disk_profile(vec3 position, vec3 normal, vec3 l, float distance_) {
#if PROFILE == PROFILE_UNIFORM || !defined(SIZED)
    return light_profile(normalize(light_from_render(position)));
#else
    vec3 x = normalize(abs(l.x) < 0.7 ? cross(l, vec3(1.0, 0.0, 0.0)) : cross(l, vec3(0.0, 1.0, 0.0)));
    vec3 y = cross(l, x);
    float radius = sqrt(light.intensity.w);
    float sum = 0.0;
    float weights = 0.0;
    for (int i = 0; i < RIM_PLACES; ++i) {
        // Of even density: Vogel 1979, "A Better Way to Construct the Sunflower Head".
        float angle = GOLDEN_ANGLE * float(i);
        float out_ = radius * sqrt((float(i) + 0.5) / float(RIM_PLACES));
        vec3 place = (x * cos(angle) + y * sin(angle)) * out_;
        // In parts of the distance, of which the fourth power must not overflow.
        vec3 towards = l + place / distance_;
        float squared = dot(towards, towards);
        float weight = max(dot(normal, towards), 0.0) / (squared * squared);
        sum += weight * light_profile(normalize(light_from_render(position - place)));
        weights += weight;
    }
    return weights > 0.0 ? sum / weights : 0.0;
#endif
}
#endif

#if defined(LOBES) && PROFILE != PROFILE_AREA
// The disk of radius `tangent` at distance 1 that a light with a radius, or an angle, shows a receiver; l: towards it.
Reflected reflected_disk(Surface s, vec3 l, vec3 v, float tangent) {
    vec3 x, y;
    orthonormal_basis(l, x, y);
    return reflected_flat_light(s, v, FlatLight(l, x * tangent, y * tangent, true));
}

// Nothing is seen wider than this: the disk's edge is as good as at the horizon.
const float WIDEST_TANGENT = 1e4;

#if MAP_KIND == MAP_ORTHOGRAPHIC
// A sun sends the same through equal parts of its disk, so its radiance grows towards the rim. A lobe that the disk fills
// sees it as it is where it looks; one that is wider sees the mean.
vec3 glossy_sun(Surface s, vec3 l, vec3 v) {
    float tangent = min(light.cone.w, WIDEST_TANGENT);
    Reflected reflected_ = reflected_disk(s, l, v, tangent);
    float rim = sqrt(1.0 + tangent * tangent);
    float squared = max(tangent * tangent, 1e-30);
    float mean = rim * (rim + 1.0) / (2.0 * squared);
    float cosine = max(dot(reflected_.toward, l), 1.0 / rim);
    float there = 1.0 / (squared * cosine * cosine * cosine);
    // The irradiance in the light block is the disk's mean cosine, 2 / (rim + 1), times what it sends.
    return reflected_.radiance * (mix(mean, there, reflected_.share) * 0.5 * (rim + 1.0) / PI);
}
#else
// Of intensity 1 on the axis. profile: the mean over the disk.
vec3 glossy_disk(Surface s, vec3 l, vec3 v, float squared_distance, float profile) {
    float squared = max(light.intensity.w, 1e-30);
    Reflected reflected_ = reflected_disk(s, l, v, min(sqrt(squared / squared_distance), WIDEST_TANGENT));
    vec3 place = sqrt(squared_distance) * (reflected_.toward / max(dot(reflected_.toward, l), 1e-4) - l);
    float there = light_profile(normalize(light_from_render(s.position - place)));
    return reflected_.radiance * (mix(profile, there, reflected_.share) / (PI * squared));
}
#endif
#endif

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, frame.size.xy))) {
        return;
    }
    vec3 sum = vec3(0.0);
#ifndef FIRST_LIGHT
    sum = imageLoad(direct_image, pixel).rgb;
#endif
    Surface s;
    float depth = read_surface_unbranched(pixel, s);
    if (depth > 0.0) {
        vec3 v = direction_to_viewer(s.position);
#if MAP_KIND == MAP_ORTHOGRAPHIC
        vec3 l = -light.axis.xyz;
#ifdef LOBES
        vec3 radiance = light.intensity.rgb * (reflected_diffuse(s, l, v, light.cone.w) + glossy_sun(s, l, v));
#else
        vec3 radiance = light.intensity.rgb * reflected(s, l, v, light.cone.w);
#endif
#else
        vec3 d = light.position.xyz - s.position;
        float squared = max(dot(d, d), 1e-20);
        vec3 l = d * inversesqrt(squared);
#if PROFILE == PROFILE_AREA
        vec3 radiance = area_light(s, v);
#else
        float profile = facing_disk_profile(s.position, s.normal, l, sqrt(squared));
        // A light with a radius is a disk that faces the point: on its axis that adds r^2 to d^2.
        float tangent = sqrt(light.intensity.w / squared);
#ifdef LOBES
        vec3 radiance =
            light.intensity.rgb * (reflected_diffuse(s, l, v, tangent) * (profile / (squared + light.intensity.w)) +
                                   glossy_disk(s, l, v, squared, profile));
#else
        vec3 radiance =
            light.intensity.rgb * (profile / (squared + light.intensity.w)) * reflected(s, l, v, tangent);
#endif
#endif
#endif
        if (any(notEqual(radiance, vec3(0.0)))) {
#ifdef SHADOW
            vec3 normal = geometric_normal(pixel);
            // Of a pixel that several frames share, each smooths its own part.
            vec3 right = step_on_plane(s.position, normal, v, pixel + ivec2(1, 0), depth) * frame.composite.z;
            vec3 up = step_on_plane(s.position, normal, v, pixel + ivec2(0, 1), depth) * frame.composite.z;
            radiance *= light_visibility(s.position, normal, right, up);
#endif
#ifdef SOFT_SHADOW
            radiance *= soft_visibility(pixel);
#endif
            sum += radiance;
        }
    }
    imageStore(direct_image, pixel, vec4(sum, 1.0));
}
