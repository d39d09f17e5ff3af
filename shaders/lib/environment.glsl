// SPDX-License-Identifier: Apache-2.0
//
// The world's image, equirectangular.
#ifndef LIB_ENVIRONMENT
#define LIB_ENVIRONMENT

#include "lib/environment_directions.glsl"
#include "shared/bindings.h"
#include "shared/types.h"

layout(std140, binding = UBO_WORLD) uniform WorldBlock {
    WorldUniforms world;
};
layout(binding = TEX_ENVIRONMENT) uniform sampler2D environment_texture;

vec3 environment_from_render(vec3 d) {
    return vec3(dot(world.environment_from_render[0].xyz, d), dot(world.environment_from_render[1].xyz, d),
                dot(world.environment_from_render[2].xyz, d));
}

// Radiance that is seen along a unit vector of the image's own axes, averaged over about so many radians.
vec3 environment_radiance(vec3 d, float radians) {
    float level = clamp(log2(max(radians, 1e-6) / world.detail.x), 0.0, world.detail.y);
    return textureLod(environment_texture, environment_place(d), level).rgb * world.environment_from_render[0].w;
}

#endif
