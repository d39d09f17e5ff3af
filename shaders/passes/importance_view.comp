// SPDX-License-Identifier: Apache-2.0
// Shows the importance map of one light (passes/vpl_importance.comp), over the mean of all texels of all lights.
#include "lib/frame.glsl"
#include "lib/map_layers.glsl"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(location = 0) uniform ivec4 map;      // the light's first texel, texels a side, texels of all lights, rows of all
layout(binding = IMG_OUT, rgba32f) writeonly uniform image2D color_image;
layout(std430, binding = SSBO_IMPORTANCE) readonly buffer ImportanceBlock { float importance[]; };
layout(std430, binding = SSBO_ROW_SUMS) readonly buffer RowBlock { float running_sums[]; };

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, frame.size.xy))) {
        return;
    }
    vec2 st;
    int layer;
    float value = 0.0;
    if (find_map_layer(pixel, st, layer)) {
        ivec2 texel = min(ivec2((st * 0.5 + 0.5) * float(map.y)), ivec2(map.y - 1));
        float mean = running_sums[map.w - 1] / float(map.z);
        value = mean > 0.0 ? importance[map.x + (layer * map.y + texel.y) * map.y + texel.x] / mean : 0.0;
    }
    imageStore(color_image, pixel, vec4(vec3(value), 1.0));
}
