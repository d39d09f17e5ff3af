// SPDX-License-Identifier: Apache-2.0
//
// A fragment's threshold between 0 and 1: of a surface with alpha a, a part a of the texels have one below a, so that maps
// hold the surface in the mean (Enderton et al. 2010, "Stochastic Transparency"). It is the same in every frame.
//
//   - In a map neighbouring texels have thresholds far apart: a lattice of two irrational steps, so that a few texels have
//     the right mean already.
//   - Of the maps of one light, each takes another of evenly spread steps, in an order of the surface's own.
//   - Surfaces behind each other take other lattices and orders: what passes both must be the product. Front and back of a
//     mesh always do, as do draws that follow each other; parts of one mesh by their triangles' numbers.
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

// One of the permutations of 0 .. count - 1, a power of two.
uint permuted(uint i, uint count, uint seed) {
    uint mask = count - 1u;
    i = ((i ^ seed) * (seed >> 8u | 1u)) & mask;
    i ^= i >> 2u;
    i = (i * (seed >> 16u | 1u)) & mask;
    i ^= i >> 3u;
    return (i + (seed >> 24u)) & mask;
}

float alpha_threshold() {
    uint side = gl_FrontFacing ? 0u : 1u;
    uint own = hash(in_surface * 2u + side + hash(uint(gl_PrimitiveID)));
    uvec2 lattice = LATTICES[(in_surface + (hash(uint(gl_PrimitiveID)) >> 7u) & 3u) * 2u + side];
    uint numbers = uint(view.eye.w);
    uint place = numbers & 4095u;
    uint places = numbers >> 12u;
    uvec2 texel = uvec2(gl_FragCoord.xy);
    uint sum = texel.x * lattice.x + texel.y * lattice.y + own;
    sum += places > 1u ? permuted(place, places, hash(own)) * (0xffffffffu / places + 1u) : place * 0x9E3779B9u;
    // 24 bits, what a float holds; the middle of the step, so that neither 0 nor 1 is a threshold.
    return (float(sum >> 8u) + 0.5) / 16777216.0;
}

#endif
