// SPDX-License-Identifier: Apache-2.0
// Searches what a pass wrote for NaN and infinities and keeps how many there are and the first of each. TEXTURE:
// a level of a texture; SAMPLES: a multisampled one; PACKED: floats within whole numbers; else: a buffer.
#include "shared/bindings.h"

layout(std430, binding = SSBO_NOT_FINITE) buffer FoundBlock { uvec4 found[]; };  // NaN, infinite, first NaN, first infinite

// By their bits: a compiler may take isnan() for false.
void look(uint bits, uint place, uint slot) {
    if ((bits & 0x7f800000u) != 0x7f800000u) {
        return;
    }
    bool nan = (bits & 0x7fffffu) != 0u;
    atomicAdd(found[slot][nan ? 0 : 1], 1u);
    atomicMin(found[slot][nan ? 2 : 3], place);
}

#ifdef TEXTURE
layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(location = 0) uniform ivec4 size;  // width, height, level, slot
#ifdef PACKED
layout(location = 1) uniform uvec2 packed_floats;  // PackedFloats: floats, halves
#define SAMPLER usampler2DArray
#define SAMPLER_FLAT usampler2D
#else
#define SAMPLER sampler2DArray
#define SAMPLER_FLAT sampler2D
#endif
#if defined(SAMPLES)
layout(binding = TEX_CHECKED) uniform sampler2DMS checked;
#elif defined(LAYERED)
layout(binding = TEX_CHECKED) uniform SAMPLER checked;
#else
layout(binding = TEX_CHECKED) uniform SAMPLER_FLAT checked;
#endif

void main() {
    // One of the groups of eight by eight looks at so many rows of texels.
    for (int row = 0; row < CHECKED_ROWS; ++row) {
        ivec2 texel = ivec2(gl_GlobalInvocationID.x,
                            (int(gl_WorkGroupID.y) * CHECKED_ROWS + row) * GROUP_2D + int(gl_LocalInvocationID.y));
        if (texel.x >= size.x || texel.y >= size.y) {
            return;
        }
        int layer = int(gl_GlobalInvocationID.z);
        uint place = (uint(layer) * uint(size.y) + uint(texel.y)) * uint(size.x) + uint(texel.x);
#if defined(SAMPLES)
        vec4 value = texelFetch(checked, texel, layer);
#elif defined(PACKED) && defined(LAYERED)
        uvec4 value = texelFetch(checked, ivec3(texel, layer), size.z);
#elif defined(PACKED)
        uvec4 value = texelFetch(checked, texel, size.z);
#elif defined(LAYERED)
        vec4 value = texelFetch(checked, ivec3(texel, layer), size.z);
#else
        vec4 value = texelFetch(checked, texel, size.z);
#endif
#ifdef PACKED
        for (int channel = 0; channel < 4; ++channel) {
            if ((packed_floats.x >> channel & 1u) != 0u) {
                look(value[channel], place, uint(size.w));
            }
            for (int part = 0; part < 2; ++part) {
                uint bits = value[channel] >> (16 * part) & 0xffffu;
                if ((packed_floats.y >> (2 * channel + part) & 1u) != 0u && (bits & 0x7c00u) == 0x7c00u) {
                    look(0x7f800000u | bits & 0x3ffu, place, uint(size.w));
                }
            }
        }
#else
        uvec4 bits = floatBitsToUint(value);
        if (any(equal(bits & 0x7f800000u, uvec4(0x7f800000u)))) {
            look(bits.x, place, uint(size.w));
            look(bits.y, place, uint(size.w));
            look(bits.z, place, uint(size.w));
            look(bits.w, place, uint(size.w));
        }
#endif
    }
}
#else
layout(local_size_x = GROUP_1D) in;
layout(std430, binding = SSBO_CHECKED) readonly buffer CheckedBlock { uint words[]; };
layout(location = 0) uniform uvec4 checked_buffer;  // words, words of an element, slot, -
layout(location = 1) uniform uvec2 floats;          // FloatWords: the lower and the upper 32 words of an element

void main() {
    uint threads = gl_NumWorkGroups.x * uint(GROUP_1D);
    for (uint i = gl_GlobalInvocationID.x; i < checked_buffer.x; i += threads) {
        uint word = i % checked_buffer.y;
        if (((word < 32u ? floats.x >> word : floats.y >> (word - 32u)) & 1u) != 0u) {
            look(words[i], i / checked_buffer.y, checked_buffer.z);
        }
    }
}
#endif
