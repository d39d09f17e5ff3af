// SPDX-License-Identifier: Apache-2.0
// Adds up the picture: direct light, indirect light times albedo, emission, world. REFLECTED: bounced light times albedo
// alone, for another one to add (RADIANCE).
#define READ_GBUFFER
#include "lib/gbuffer.glsl"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(binding = IMG_OUT, rgba32f) writeonly uniform image2D color_image;
#ifdef DIRECT
layout(binding = TEX_DIRECT) uniform sampler2D direct_texture;
#endif
#ifdef INDIRECT
layout(binding = TEX_INDIRECT) uniform sampler2D irradiance_texture;
#endif
#ifdef BOUNCED
#include "lib/bounced.glsl"
layout(binding = IMG_IN, rgba32ui) readonly uniform uimage2D bounced_image;
#endif
#ifdef ENVIRONMENT
#include "lib/environment.glsl"

// Four rays a pixel, each averaged over a part of it, spread by as much as Cycles' filter (Blackman-Harris, 1.5 pixels to
// either side) in the mean square.
const float RAY_OFFSET = 0.4;
const float RAY_WIDTH = 0.4;

// Unit vector that a place of the picture looks along, pixels.
vec3 view_direction(vec2 place) {
    vec2 ndc = place / vec2(frame.size.xy) * 2.0 - 1.0;
    vec4 p = frame.render_from_clip * vec4(ndc, 0.5, 1.0);
    return frame.camera_position.w > 0.5 ? normalize(p.xyz / p.w - frame.camera_position.xyz) : frame.camera_forward.xyz;
}

vec3 background(ivec2 pixel) {
    vec2 middle = vec2(pixel) + 0.5;
    // Radians between this ray and the next pixel's; an orthographic camera's rays are all the same.
    float between = length(view_direction(middle + vec2(1.0, 0.0)) - view_direction(middle));
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        vec2 offset = RAY_OFFSET * (vec2(i & 1, i >> 1) * 2.0 - 1.0);
        sum += environment_radiance(environment_from_render(view_direction(middle + offset)), RAY_WIDTH * between);
    }
    return 0.25 * sum;
}
#endif
#ifdef ENVIRONMENT_GLOSSY
#include "lib/bounced.glsl"
#include "lib/environment_glossy.glsl"
layout(binding = IMG_LOBES, rgba32ui) readonly uniform uimage2D lobes_image;

// Radians between the mirrored rays of this pixel and of the nearer of two neighbours along an axis: the other may be
// another surface.
float mirrored_footprint(ivec2 pixel, vec3 mirrored, ivec2 axis) {
    float least = 2.0;
    for (int side = -1; side <= 1; side += 2) {
        ivec2 other = clamp(pixel + side * axis, ivec2(0), frame.size.xy - 1);
        Surface s;
        float depth = read_surface_unbranched(other, s);
        vec3 there = reflect(-direction_to_viewer(s.position), s.normal);
        least = depth > 0.0 && other != pixel ? min(least, length(there - mirrored)) : least;
    }
    return least < 2.0 ? least : 0.0;
}

vec3 reflected_environment(ivec2 pixel, Surface s) {
    vec3 v = direction_to_viewer(s.position);
    vec3 mirrored = reflect(-v, s.normal);
    float footprint = max(mirrored_footprint(pixel, mirrored, ivec2(1, 0)), mirrored_footprint(pixel, mirrored, ivec2(0, 1)));
    // What of the light that the lobe gathers is not hidden, of all that it would.
    vec2 lobes = unpack_bounced(imageLoad(lobes_image, pixel)).irradiance.xy;
    float seen = lobes.y > 0.0 ? clamp(lobes.x / lobes.y, 0.0, 1.0) : 1.0;
    return environment_glossy(s, v, footprint) * seen;
}
#endif
#ifdef RADIANCE
layout(binding = TEX_RSM) uniform sampler2D radiance_texture;
#endif
#ifdef EMISSION
layout(binding = TEX_GBUFFER2) uniform sampler2D emission_texture;
#endif
#ifdef LAYER
layout(binding = TEX_GEOMETRIC_NORMAL) uniform sampler2D layer_texture;  // z: alpha, 0 where no surface is
#endif

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, frame.size.xy))) {
        return;
    }
#ifdef REFLECTED
    vec3 color = vec3(0.0);
    const float exposure = 1.0;
#else
#ifdef ENVIRONMENT
    vec3 color = background(pixel) * frame.composite.y;
#else
    vec3 color = frame.world_radiance.rgb * frame.composite.y;
#endif
    float exposure = frame.composite.x;
#endif
    Surface s;
    if (read_surface(pixel, s)) {
        color = vec3(0.0);
#ifdef DIRECT
        color += texelFetch(direct_texture, pixel, 0).rgb;
#endif
#ifdef INDIRECT
        color += diffuse_albedo(s) / PI * texelFetch(irradiance_texture, pixel, 0).rgb;
#endif
#ifdef BOUNCED
        BouncedLight bounced = unpack_bounced(imageLoad(bounced_image, pixel));
        color += (diffuse_albedo(s) / PI * bounced.irradiance + bounced.glossy) / frame.composite.w;
#endif
#ifdef ENVIRONMENT_GLOSSY
        color += reflected_environment(pixel, s) * frame.composite.y;
#endif
#ifdef RADIANCE
        color += texelFetch(radiance_texture, pixel, 0).rgb;
#endif
#ifdef WORLD
        // The world's light without occlusion; metals reflect it as well as the rest diffuses it.
        color += s.base_color * frame.world_radiance.rgb * frame.composite.y;
#endif
#ifdef EMISSION
        color += texelFetch(emission_texture, pixel, 0).rgb * frame.composite.y;
#endif
    }
#ifdef LAYER
    float alpha = texelFetch(layer_texture, pixel, 0).z;
    imageStore(color_image, pixel, alpha > 0.0 ? vec4(color * (exposure * alpha), alpha) : vec4(0.0));
#else
    imageStore(color_image, pixel, vec4(color * exposure, 1.0));
#endif
}
