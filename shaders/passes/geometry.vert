// SPDX-License-Identifier: Apache-2.0
// Every raster pass over the scene: G-buffer, shadow map, RSM.
#include "shared/bindings.h"
#include "shared/types.h"

layout(location = ATTRIB_POSITION) in vec3 in_position;
layout(location = ATTRIB_DRAW) in uint in_draw;

layout(std140, binding = UBO_VIEW) uniform ViewBlock {
    ViewUniforms view;
};
layout(std430, binding = SSBO_DRAWS) readonly buffer DrawBlock {
    GpuDraw draws[];
};

#if defined(BASE_COLOR_TEXTURE) || defined(METALLIC_ROUGHNESS_TEXTURE) || defined(NORMAL_TEXTURE) || \
    defined(EMISSION_TEXTURE)
#define ANY_TEXTURE
layout(location = ATTRIB_UV0) in vec2 in_uv0;
layout(location = ATTRIB_UV1) in vec2 in_uv1;
layout(location = 3) out vec4 out_uv;
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
#ifdef LIGHT_VIEW
#include "lib/light.glsl"
layout(location = 5) out vec3 out_light_space;
#endif

void main() {
    GpuDraw draw = draws[in_draw];
    vec4 p = vec4(in_position, 1.0);
    vec3 position = vec3(dot(draw.render_from_model[0], p), dot(draw.render_from_model[1], p),
                         dot(draw.render_from_model[2], p));
    gl_Position = view.clip_from_render * vec4(position, 1.0);
    out_material = uint(draw.ids.x);
#ifndef DEPTH_ONLY
    out_normal = vec3(dot(draw.normal_from_model[0].xyz, in_normal), dot(draw.normal_from_model[1].xyz, in_normal),
                      dot(draw.normal_from_model[2].xyz, in_normal));
#ifdef NORMAL_TEXTURE
    vec3 tangent = vec3(dot(draw.render_from_model[0].xyz, in_tangent.xyz),
                        dot(draw.render_from_model[1].xyz, in_tangent.xyz),
                        dot(draw.render_from_model[2].xyz, in_tangent.xyz));
    out_tangent = vec4(tangent * inversesqrt(max(dot(tangent, tangent), 1e-30)), in_tangent.w);
#endif
#endif
#ifdef ANY_TEXTURE
    out_uv = vec4(in_uv0, in_uv1);
#endif
#ifdef VERTEX_COLOR
    out_color = in_color;
#endif
#ifdef LIGHT_VIEW
    out_light_space = light_from_render(position);
#endif
}
