// SPDX-License-Identifier: Apache-2.0
// Adds up the picture: direct light, indirect light times albedo, emission, world.
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
    vec3 color = frame.world_radiance.rgb * frame.composite.y;
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
    imageStore(color_image, pixel, alpha > 0.0 ? vec4(color * (frame.composite.x * alpha), alpha) : vec4(0.0));
#else
    imageStore(color_image, pixel, vec4(color * frame.composite.x, 1.0));
#endif
}
