// SPDX-License-Identifier: Apache-2.0
// Every raster pass over the scene: G-buffer, shadow map, RSM, motion.
#include "lib/view.glsl"

layout(location = ATTRIB_POSITION) in vec3 in_position;

#if !defined(SINGLE_DRAW) || defined(MOTION)
layout(location = ATTRIB_DRAW) in uint in_draw;
#endif
#ifdef SINGLE_DRAW
// A draw that stands alone: constant offsets of a uniform block are scalar loads on every driver.
layout(std140, binding = UBO_DRAW) uniform DrawBlock {
    GpuDraw draw;
};
#else
layout(std430, binding = SSBO_DRAWS) readonly buffer DrawBlock {
    GpuDraw draws[];
};
#endif

#if defined(BASE_COLOR_TEXTURE) || defined(METALLIC_ROUGHNESS_TEXTURE) || defined(NORMAL_TEXTURE) || \
    defined(EMISSION_TEXTURE)
#define ANY_TEXTURE
layout(location = ATTRIB_UV0) in vec2 in_uv0;
layout(location = ATTRIB_UV1) in vec2 in_uv1;
layout(location = 3) out vec4 out_uv_base_mr;          // of the base colour and metallic-roughness textures
layout(location = 6) out vec4 out_uv_normal_emission;  // of the normal and emission textures
layout(std430, binding = SSBO_MATERIALS) readonly buffer MaterialBlock {
    GpuMaterial materials[];
};

// Here and not for each pixel: a texture's level of detail comes from the pixel's neighbours, and those outside
// the triangle (helper invocations) read zeros from a storage buffer on some drivers, so that the level jumps.
vec2 texture_uv(int material, int slot) {
    vec4 row = materials[material].uv[2 * slot];
    vec3 uv = vec3(row.w > 0.5 ? in_uv1 : in_uv0, 1.0);
    return vec2(dot(row.xyz, uv), dot(materials[material].uv[2 * slot + 1].xyz, uv));
}
#endif
#ifndef DEPTH_ONLY
layout(location = ATTRIB_NORMAL) in vec3 in_normal;
layout(location = 1) out vec3 out_normal;
#ifdef NORMAL_TEXTURE
layout(location = ATTRIB_TANGENT) in vec4 in_tangent;
layout(location = 2) out vec4 out_tangent;
#endif
#endif
#ifdef VERTEX_COLOR
layout(location = ATTRIB_COLOR) in vec4 in_color;
layout(location = 4) out vec4 out_color;
#endif
layout(location = 0) flat out uint out_material;
#ifdef BLEND_RULE
#if BLEND_RULE == BLEND_HASHED
#define HASHED_ALPHA
#endif
#endif
#ifdef HASHED_ALPHA
layout(location = 8) flat out uint out_surface;
#endif
#ifdef LIGHT_VIEW
#include "lib/light.glsl"
layout(location = 5) out vec3 out_light_space;
#elif !defined(DEPTH_ONLY)
layout(location = 7) out vec3 out_position;
#endif
#ifdef SET_BACK
layout(location = 11) flat out float out_set_back;
#endif
#ifdef MOTION
layout(location = 8) out vec4 out_clip;
layout(location = 9) out vec4 out_previous_clip;
layout(location = 10) flat out uint out_drawn_before;
layout(std140, binding = UBO_MOTION) uniform MotionBlock {
    MotionUniforms motion;
};
layout(std430, binding = SSBO_PREVIOUS_DRAWS) readonly buffer PreviousDrawBlock {
    GpuPreviousDraw previous_draws[];
};
layout(std430, binding = SSBO_PREVIOUS_POSITIONS) readonly buffer PreviousPositionBlock {
    float previous_positions[];
};
#endif

void main() {
#ifndef SINGLE_DRAW
    GpuDraw draw = draws[in_draw];
#endif
    vec4 p = vec4(in_position, 1.0);
    vec3 position = vec3(dot(draw.render_from_model[0], p), dot(draw.render_from_model[1], p),
                         dot(draw.render_from_model[2], p));
#ifdef PARABOLOID
    // The depth is the fragment's to write. What is straight behind the light has no place in its map; what is behind it
    // at all is clipped.
    vec3 local = (view.clip_from_render * vec4(position, 1.0)).xyz;
    float len = length(local);
    gl_Position = vec4(local.xy / max(len + local.z, 1e-3 * len + 1e-20), 0.0, 1.0);
    gl_ClipDistance[0] = local.z;
#else
    gl_Position = view.clip_from_render * vec4(position, 1.0);
#endif
#ifdef SET_BACK
    out_set_back = intBitsToFloat(draw.ids.w);
#endif
    out_material = uint(draw.ids.x);
#ifdef HASHED_ALPHA
    out_surface = uint(draw.ids.z);
#endif
#ifndef DEPTH_ONLY
    out_normal = vec3(dot(draw.normal_from_model[0].xyz, in_normal), dot(draw.normal_from_model[1].xyz, in_normal),
                      dot(draw.normal_from_model[2].xyz, in_normal));
#ifdef NORMAL_TEXTURE
    vec3 tangent = vec3(dot(draw.render_from_model[0].xyz, in_tangent.xyz),
                        dot(draw.render_from_model[1].xyz, in_tangent.xyz),
                        dot(draw.render_from_model[2].xyz, in_tangent.xyz));
    // A mirroring transform turns the bitangent over against cross(normal, tangent).
    out_tangent = vec4(tangent * inversesqrt(max(dot(tangent, tangent), 1e-30)),
                       draw.ids.y == 1 ? -in_tangent.w : in_tangent.w);
#endif
#endif
#ifdef ANY_TEXTURE
    out_uv_base_mr = vec4(texture_uv(draw.ids.x, TEX_BASE_COLOR), texture_uv(draw.ids.x, TEX_METALLIC_ROUGHNESS));
    out_uv_normal_emission = vec4(texture_uv(draw.ids.x, TEX_NORMAL), texture_uv(draw.ids.x, TEX_EMISSION));
#endif
#ifdef VERTEX_COLOR
    out_color = in_color;
#endif
#ifdef LIGHT_VIEW
    out_light_space = light_from_render(position);
#elif !defined(DEPTH_ONLY)
    out_position = position;
#endif
#ifdef MOTION
    GpuPreviousDraw before = previous_draws[in_draw];
    int first = 3 * gl_VertexID;
    vec4 q = vec4(previous_positions[first], previous_positions[first + 1], previous_positions[first + 2], 1.0);
    vec3 previous = vec3(dot(before.render_from_model[0], q), dot(before.render_from_model[1], q),
                         dot(before.render_from_model[2], q));
    out_clip = gl_Position;
    out_previous_clip = motion.clip_from_render * vec4(previous, 1.0);
    out_drawn_before = uint(before.ids.x);
#endif
}
