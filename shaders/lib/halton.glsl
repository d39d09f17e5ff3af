// SPDX-License-Identifier: Apache-2.0
//
// Points of the Halton sequence, and what makes others of them.
#ifndef LIB_HALTON
#define LIB_HALTON

float radical_inverse(uint base, uint i) {
    float inverse = 1.0 / float(base);
    float digit = inverse;
    float value = 0.0;
    while (i > 0u) {
        value += float(i % base) * digit;
        i /= base;
        digit *= inverse;
    }
    return value;
}

uint hash(uint x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

float to_unit(uint bits) {
    return float(bits >> 8) * (1.0 / 16777216.0);
}

// By how much a sequence of points turns about the unit square (Cranley and Patterson 1976, "Randomization of Number
// Theoretic Methods for Multiple Integration"); another one for each number and seed.
vec2 seeded_turn(uint seed, uint number) {
    uint bits = hash(seed * 0x9e3779b9u + hash(number));
    return vec2(to_unit(bits), to_unit(hash(bits + 1u)));
}

#endif
