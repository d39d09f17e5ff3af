// SPDX-License-Identifier: Apache-2.0
//
// What texels count for, as passes/vpl_importance.comp wrote it. The includer has source_size() and source_rows().
#ifndef LIB_IMPORTANCE_MAP
#define LIB_IMPORTANCE_MAP

layout(location = UNIFORM_IMPORTANCE_FIRST) uniform int importance_first;  // texel of the light's map
layout(std430, binding = SSBO_IMPORTANCE) readonly buffer ImportanceBlock { float importance_map[]; };

float texel_importance(ivec2 texel, int layer) {
    return importance_map[importance_first + (layer * source_rows() + texel.y) * source_size() + texel.x];
}

#endif
