// SPDX-License-Identifier: Apache-2.0
// Closes bare places inside surfaces in maps that do not fit into shared memory; a layer of groups a map.
#include "lib/ism.glsl"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(binding = IMG_IN, r32ui) readonly uniform uimage2D atlas_image;
layout(binding = IMG_OUT, r32ui) writeonly uniform uimage2D closed_image;

ivec2 origin;
#define LOAD_CLOSE(texel) imageLoad(atlas_image, origin + (texel)).r
#include "lib/ism_close.glsl"

void main() {
    origin = ism_origin(int(gl_WorkGroupID.z));
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    imageStore(closed_image, origin + texel, uvec4(closed_texel(texel)));
}
