// SPDX-License-Identifier: Apache-2.0
//
// A fragment's threshold between 0 and 1: of a surface with alpha a, a part a of the texels have one below a, so that maps
// hold the surface in the mean (Enderton et al. 2010, "Stochastic Transparency"). It is the same in every frame.
//
//   - In a single map neighbouring texels have thresholds far apart: a lattice of two irrational steps, so that a few texels
//     have the right mean already.
//   - Of the maps from several places on a light each has one step of evenly spread thresholds for all of a surface, the
//     lattice but within it: where every map holds or lacks the whole surface, the mean of them has no noise.
//   - Surfaces behind each other take other lattices, and other dimensions of Sobol's sequence: what passes both must be the
//     product. Front and back of a mesh always do, as do draws that follow each other; parts of one mesh by their triangles'
//     numbers.
#ifndef LIB_ALPHA_THRESHOLD
#define LIB_ALPHA_THRESHOLD

#include "lib/view.glsl"

layout(location = 8) flat in uint in_surface;

// Steps of the lattices along x and y, parts of 2^32: those of the plastic number (Roberts 2018, "The Unreasonable
// Effectiveness of Quasirandom Sequences"), of square roots, and both mirrored and exchanged.
const uvec2 LATTICES[8] = uvec2[8](uvec2(0xC13FA9A9u, 0x91E10DA5u), uvec2(0x6A09E667u, 0xBB67AE85u),
                                   uvec2(0x91E10DA5u, 0x3EC05657u), uvec2(0xBB67AE85u, 0x95F61999u),
                                   uvec2(0xD1B54A32u, 0xABC98388u), uvec2(0xA54FF53Au, 0x3C6EF372u),
                                   uvec2(0xABC98388u, 0x2E4AB5CEu), uvec2(0x3C6EF372u, 0x5AB00AC6u));

// Jarzynski and Olano 2020, "Hash Functions for GPU Rendering": PCG.
uint hash(uint x) {
    uint state = x * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// First direction numbers of Sobol's sequence in dimensions 4 to 11 (Joe and Kuo 2008, "Constructing Sobol Sequences with
// Better Two-Dimensional Projections"); the places on a light are those of the first three.
const uint DIRECTIONS[8][8] = uint[8][8](
    uint[8](0x80000000u, 0xC0000000u, 0x20000000u, 0x50000000u, 0xF8000000u, 0x74000000u, 0xA2000000u, 0x93000000u),
    uint[8](0x80000000u, 0x40000000u, 0x20000000u, 0xB0000000u, 0xF8000000u, 0xDC000000u, 0x7A000000u, 0x9D000000u),
    uint[8](0x80000000u, 0x40000000u, 0x60000000u, 0x30000000u, 0xC8000000u, 0x24000000u, 0x56000000u, 0xFB000000u),
    uint[8](0x80000000u, 0xC0000000u, 0xA0000000u, 0xD0000000u, 0x58000000u, 0x94000000u, 0x3E000000u, 0xE3000000u),
    uint[8](0x80000000u, 0x40000000u, 0xA0000000u, 0x50000000u, 0x88000000u, 0x24000000u, 0x12000000u, 0x2D000000u),
    uint[8](0x80000000u, 0x40000000u, 0xA0000000u, 0x50000000u, 0x28000000u, 0xD4000000u, 0x6A000000u, 0x71000000u),
    uint[8](0x80000000u, 0x40000000u, 0xE0000000u, 0xB0000000u, 0x98000000u, 0x94000000u, 0x8A000000u, 0x5B000000u),
    uint[8](0x80000000u, 0x40000000u, 0xA0000000u, 0x10000000u, 0x08000000u, 0x6C000000u, 0x9E000000u, 0x23000000u));

// Of 32 bits; scrambled as by Owen (Laine and Karras 2011, "Stratified Sampling for Stochastic Transparency").
uint sobol(uint index, uint dimension, uint seed) {
    uint x = 0u;
    for (uint bit = 0u; bit < 8u; ++bit) {
        x ^= (index >> bit & 1u) * DIRECTIONS[dimension][bit];
    }
    x = bitfieldReverse(x) + seed;
    x ^= x * 0x6C50B47Cu;
    x ^= x * 0xB82F1E52u;
    x ^= x * 0xC7AFE638u;
    x ^= x * 0x8D22F6E6u;
    return bitfieldReverse(x);
}

float alpha_threshold() {
    uint side = gl_FrontFacing ? 0u : 1u;
    uint own = hash(in_surface * 2u + side + hash(uint(gl_PrimitiveID)));
    uint variant = (in_surface + (hash(uint(gl_PrimitiveID)) >> 7u) & 3u) * 2u + side;
    uvec2 texel = uvec2(gl_FragCoord.xy);
    uint sum = texel.x * LATTICES[variant].x + texel.y * LATTICES[variant].y + own;
    uint numbers = uint(view.eye.w);
    uint place = numbers & 4095u;
    uint places = numbers >> 12u;  // a power of two
    if (places > 1u) {
        uint step_ = 0xffffffffu / places + 1u;
        sum = (sobol(place, variant, own) & ~(step_ - 1u)) | sum / places;
    } else {
        sum += place * 0x9E3779B9u;
    }
    // 24 bits, what a float holds; the middle of the step, so that neither 0 nor 1 is a threshold.
    return (float(sum >> 8u) + 0.5) / 16777216.0;
}

#endif
