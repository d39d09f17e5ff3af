// SPDX-License-Identifier: Apache-2.0
//
// alpha_test() of fragment shaders that need no more of the material; compiled out where nothing is cut.
#ifndef LIB_ALPHA_TEST
#define LIB_ALPHA_TEST

#ifdef ALPHA_TEST
#include "lib/alpha_cut.glsl"

layout(std430, binding = SSBO_MATERIALS) readonly buffer MaterialBlock {
    GpuMaterial materials[];
};
layout(location = 0) flat in uint in_material;
#ifdef BASE_COLOR_TEXTURE
layout(location = 3) in vec4 in_uv_base_mr;
layout(binding = TEX_BASE_COLOR) uniform sampler2D base_color_texture;
#endif
#ifdef VERTEX_COLOR
layout(location = 4) in vec4 in_color;
#endif

void alpha_test() {
    GpuMaterial m = materials[in_material];
    float alpha = m.base_color.a;
#ifdef BASE_COLOR_TEXTURE
    alpha *= texture(base_color_texture, in_uv_base_mr.xy).a;
#endif
#ifdef VERTEX_COLOR
    alpha *= in_color.a;
#endif
    if (is_cut(m, alpha)) {
        discard;
    }
}
#else
void alpha_test() {}
#endif

#endif
