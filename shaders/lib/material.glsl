// SPDX-License-Identifier: Apache-2.0
//
// Fetches a material in a fragment shader. What a batch does not have is compiled out.
#ifndef LIB_MATERIAL
#define LIB_MATERIAL

#include "lib/brdf.glsl"
#ifdef ALPHA_TEST
#include "lib/alpha_cut.glsl"
#endif
#include "shared/bindings.h"
#include "shared/types.h"

layout(std430, binding = SSBO_MATERIALS) readonly buffer MaterialBlock {
    GpuMaterial materials[];
};

#if defined(BASE_COLOR_TEXTURE) || defined(METALLIC_ROUGHNESS_TEXTURE) || defined(NORMAL_TEXTURE) || \
    defined(EMISSION_TEXTURE)
#define ANY_TEXTURE
#endif

#ifdef BASE_COLOR_TEXTURE
layout(binding = TEX_BASE_COLOR) uniform sampler2D base_color_texture;
#endif
#ifdef METALLIC_ROUGHNESS_TEXTURE
layout(binding = TEX_METALLIC_ROUGHNESS) uniform sampler2D metallic_roughness_texture;
#endif
#ifdef NORMAL_TEXTURE
layout(binding = TEX_NORMAL) uniform sampler2D normal_texture;
#endif
#ifdef EMISSION_TEXTURE
layout(binding = TEX_EMISSION) uniform sampler2D emission_texture;
#endif

layout(location = 0) flat in uint in_material;
layout(location = 1) in vec3 in_normal;
#ifdef NORMAL_TEXTURE
layout(location = 2) in vec4 in_tangent;
#endif
#ifdef ANY_TEXTURE
// Transformed by the vertex shader (passes/geometry.vert).
layout(location = 3) in vec4 in_uv_base_mr;
layout(location = 6) in vec4 in_uv_normal_emission;
#endif
#ifdef VERTEX_COLOR
layout(location = 4) in vec4 in_color;
#endif

// IEC 61966-2-1.
vec3 linear_from_srgb(vec3 c) {
    return mix(pow((c + 0.055) / 1.055, vec3(2.4)), c / 12.92, lessThanEqual(c, vec3(0.04045)));
}

vec4 material_base_color(GpuMaterial m) {
    vec4 color = m.base_color;
#ifdef BASE_COLOR_TEXTURE
    vec4 texel = texture(base_color_texture, in_uv_base_mr.xy);
#ifdef BASE_COLOR_ENCODED
    texel.rgb = linear_from_srgb(texel.rgb);
#endif
    color *= texel;
#endif
#ifdef VERTEX_COLOR
    color *= in_color;
#endif
    return color;
}

// Fills all but the position. Discards what an alpha test cuts away.
Surface material_surface(out vec3 emission, out float alpha) {
    GpuMaterial m = materials[in_material];
    vec4 base_color = material_base_color(m);
    alpha = base_color.a;
#ifdef ALPHA_TEST
    if (is_cut(m, base_color.a)) {
        discard;
    }
#endif
    Surface s;
    s.position = vec3(0.0);
    s.base_color = base_color.rgb;
    s.metallic = m.surface.x;
    s.roughness = m.surface.y;
    s.specular = m.surface.z;
    s.disney = m.flags.x == DIFFUSE_DISNEY;
#ifdef METALLIC_ROUGHNESS_TEXTURE
    vec4 mr = texture(metallic_roughness_texture, in_uv_base_mr.zw);
#ifdef METALLIC_ROUGHNESS_ENCODED
    mr.rgb = linear_from_srgb(mr.rgb);
#endif
    s.roughness *= mr.g;
    s.metallic *= mr.b;
#endif
    vec3 normal = safe_normalize(in_normal, vec3(0.0, 0.0, 1.0));
#ifdef NORMAL_TEXTURE
    vec3 encoded_normal = texture(normal_texture, in_uv_normal_emission.xy).xyz;
#ifdef NORMAL_ENCODED
    encoded_normal = linear_from_srgb(encoded_normal);
#endif
    vec3 tangent_normal = encoded_normal * 2.0 - 1.0;
    if (m.flags.z == 1) {
        // Cycles goes from the surface's normal to the map's, and beyond where the strength is above 1.
        tangent_normal = mix(vec3(0.0, 0.0, 1.0), safe_normalize(tangent_normal, vec3(0.0, 0.0, 1.0)), m.surface.w);
    } else {
        tangent_normal.xy *= m.surface.w;
    }
    vec3 bitangent = cross(normal, in_tangent.xyz) * in_tangent.w;
    normal = safe_normalize(
        in_tangent.xyz * tangent_normal.x + bitangent * tangent_normal.y + normal * tangent_normal.z, normal);
#endif
    s.normal = gl_FrontFacing ? normal : -normal;
    emission = vec3(0.0);
#ifdef EMISSION
    emission = m.emission.rgb;
#ifdef EMISSION_TEXTURE
    vec3 glow = texture(emission_texture, in_uv_normal_emission.zw).rgb;
#ifdef EMISSION_ENCODED
    glow = linear_from_srgb(glow);
#endif
    emission *= glow;
#endif
#endif
    if (m.flags.y == 1) {  // unlit: shown as it is, reflects nothing, to the viewer and to other surfaces
        emission = s.base_color;
        s.base_color = vec3(0.0);
        s.metallic = 0.0;
        s.specular = 0.0;
    }
    return s;
}

Surface material_surface(out vec3 emission) {
    float alpha;
    return material_surface(emission, alpha);
}

#endif
