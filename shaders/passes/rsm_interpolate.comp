// SPDX-License-Identifier: Apache-2.0
//
// Screen-space interpolation (Dachsbacher and Stamminger 2005, section 4): a pixel takes the bilinear mean
// of its four low-resolution neighbours where three or four of them lie on the same surface, near by and
// with a similar normal. The others are listed, tile by tile, for the full gather; a tile that is finished
// adds nothing to the list, which is what the paper's occlusion query for each screen quad is for.
#define READ_GBUFFER
#include "lib/gbuffer.glsl"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(binding = TEX_LOWRES) uniform sampler2D lowres_texture;
layout(binding = IMG_OUT, rgba32f) writeonly uniform image2D irradiance_image;
layout(std430, binding = SSBO_PIXEL_LIST) writeonly buffer PixelListBlock {
    uint pixel_list[];
};
layout(std430, binding = SSBO_DISPATCH) buffer DispatchBlock {
    uvec4 dispatch;  // groups in x, 1, 1, pixels
};

shared uint tile_count;
shared uint tile_first;

bool interpolate(ivec2 pixel, Surface s, out vec3 irradiance) {
    int step = frame.size.z;
    ivec2 cells = textureSize(lowres_texture, 0);
    vec2 at = (vec2(pixel) - float(step / 2)) / float(step);
    ivec2 base = ivec2(floor(at));
    vec2 f = at - vec2(base);
    // A low-resolution cell's width, and how far it stretches over a surface that is seen at an angle (bounded
    // where it is seen edge on).
    float cell = 2.0 * pixel_footprint(s.position) * float(step);
    float stretched = cell / max(abs(dot(s.normal, direction_to_viewer(s.position))), 0.1);
    float reach = frame.interpolation.w * stretched;
    float weights = 0.0;
    int suitable = 0;
    irradiance = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        ivec2 q = clamp(base + corner, ivec2(0), cells - 1);
        ivec2 q_pixel = min(q * step + step / 2, frame.size.xy - 1);
        float depth = texelFetch(depth_texture, q_pixel, 0).r;
        if (depth == 0.0) {
            continue;
        }
        vec3 offset = pixel_position(q_pixel, depth) - s.position;
        vec4 g1 = texelFetch(gbuffer1_texture, q_pixel, 0);
        bool similar = dot(unpack_normal(g1), s.normal) >= frame.interpolation.x;
        bool close = abs(dot(offset, s.normal)) <= frame.interpolation.y * cell &&
                     dot(offset, offset) <= reach * reach;
        if (similar && close) {
            float w = (corner.x == 1 ? f.x : 1.0 - f.x) * (corner.y == 1 ? f.y : 1.0 - f.y);
            irradiance += texelFetch(lowres_texture, q, 0).rgb * w;
            weights += w;
            ++suitable;
        }
    }
    irradiance /= max(weights, 1e-6);
    return suitable >= 3 && weights > 1e-3;
}

void main() {
    if (gl_LocalInvocationIndex == 0u) {
        tile_count = 0u;
    }
    barrier();
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    bool listed = false;
    if (all(lessThan(pixel, frame.size.xy))) {
        Surface s;
        vec3 irradiance = vec3(0.0);
        if (read_surface(pixel, s)) {
            listed = !interpolate(pixel, s, irradiance);
        }
        imageStore(irradiance_image, pixel, vec4(listed ? vec3(0.0) : irradiance, listed ? 0.0 : 1.0));
    }
    uint place = listed ? atomicAdd(tile_count, 1u) : 0u;
    barrier();
    if (gl_LocalInvocationIndex == 0u && tile_count > 0u) {
        tile_first = atomicAdd(dispatch.w, tile_count);
        atomicMax(dispatch.x, (tile_first + tile_count + uint(GROUP_1D) - 1u) / uint(GROUP_1D));
    }
    barrier();
    if (listed) {
        pixel_list[tile_first + place] = uint(pixel.x) | (uint(pixel.y) << 16);
    }
}
