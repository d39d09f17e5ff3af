// SPDX-License-Identifier: Apache-2.0
// Adds one light's direct illumination: Cycles' laws, the material's full BRDF, a hard shadow.
#define READ_GBUFFER
#include "lib/gbuffer.glsl"
#include "lib/light.glsl"
#ifdef SHADOW
#include "lib/shadow.glsl"
#endif

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(binding = IMG_OUT, rgba32f) uniform image2D direct_image;

#ifdef SHADOW
layout(binding = TEX_GEOMETRIC_NORMAL) uniform sampler2D geometric_normal_texture;

// A shadow map holds triangles, not what normal maps and smooth shading make of them.
vec3 geometric_normal(ivec2 pixel) {
    return octahedral_decode(texelFetch(geometric_normal_texture, pixel, 0).xy * 2.0 - 1.0);
}

// The step on a surface's plane from a pixel to another, which shows a point at the same depth.
vec3 step_on_plane(vec3 position, vec3 normal, vec3 v, ivec2 other, float depth) {
    vec3 d = pixel_position(other, depth) - position;
    // A plane seen from its edge goes on for ever; its filter does not.
    float slant = dot(normal, v);
    slant = slant < 0.0 ? min(slant, -0.05) : max(slant, 0.05);
    return d - v * (dot(normal, d) / slant);
}
#endif

// Radiance towards v for irradiance 1 W/m^2 on a plane across l.
vec3 reflected(Surface s, vec3 l, vec3 v) {
    float n_dot_l = dot(s.normal, l);
    if (n_dot_l <= 0.0) {
        return vec3(0.0);
    }
    float factor = 1.0;
#ifdef DISNEY
    if (s.disney) {
        factor = disney_diffuse_factor(n_dot_l, dot(s.normal, v), dot(l, v), s.roughness);
    }
#endif
    vec3 radiance = diffuse_albedo(s) * (n_dot_l * factor / PI);
#ifdef SPECULAR
    radiance += specular_times_cosine(s, l, v);
#endif
    return radiance;
}

#if PROFILE == PROFILE_AREA
// Points a side of the stratified grid over an area light: enough for receivers farther away than the light is
// wide; nearer than that the points themselves begin to show.
const int AREA_GRID = 4;

vec3 area_light(Surface s, vec3 v) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < AREA_GRID * AREA_GRID; ++i) {
        vec2 u = (vec2(i % AREA_GRID, i / AREA_GRID) + 0.5) / float(AREA_GRID);
        // A disk or ellipse: radius by the square root keeps the points' areas equal.
        float angle = 2.0 * PI * (u.y + 0.5 * u.x);
        vec2 on_disk = sqrt(u.x) * vec2(cos(angle), sin(angle));
        vec2 offset = (light.map.w > 0.5 ? on_disk : u * 2.0 - 1.0) * light.area.xy;
        vec3 d = light.position.xyz + light.tangent.xyz * offset.x + light.bitangent.xyz * offset.y - s.position;
        float squared = max(dot(d, d), 1e-20);
        vec3 l = d * inversesqrt(squared);
        vec3 from_light = -vec3(dot(l, light.tangent.xyz), dot(l, light.bitangent.xyz), dot(l, light.axis.xyz));
        sum += reflected(s, l, v) * (light_profile(from_light) / squared);
    }
    return light.intensity.rgb * sum / float(AREA_GRID * AREA_GRID);
}
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
        vec3 radiance = light.intensity.rgb * reflected(s, l, v);
#else
        vec3 d = light.position.xyz - s.position;
        float squared = max(dot(d, d), 1e-20);
        vec3 l = d * inversesqrt(squared);
#if PROFILE == PROFILE_AREA
        vec3 radiance = area_light(s, v);
#else
        float profile = light_profile(normalize(light_from_render(s.position)));
        // A light with a radius is a disk that faces the point: on its axis that adds r^2 to d^2.
        vec3 radiance = light.intensity.rgb * (profile / (squared + light.intensity.w)) * reflected(s, l, v);
#endif
#endif
        if (max(max(radiance.r, radiance.g), radiance.b) > 0.0) {
#ifdef SHADOW
            vec3 normal = geometric_normal(pixel);
            // Of a pixel that several frames share, each smooths its own part.
            vec3 right = step_on_plane(s.position, normal, v, pixel + ivec2(1, 0), depth) * frame.composite.z;
            vec3 up = step_on_plane(s.position, normal, v, pixel + ivec2(0, 1), depth) * frame.composite.z;
            radiance *= light_visibility(s.position, normal, right, up);
#endif
            sum += radiance;
        }
    }
    imageStore(direct_image, pixel, vec4(sum, 1.0));
}
