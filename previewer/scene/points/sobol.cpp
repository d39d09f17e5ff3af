// SPDX-License-Identifier: Apache-2.0
#include "scene/points/sobol.h"

#include <array>

namespace bounce::scene {
namespace {

using Directions = std::array<uint32_t, 32>;

// From the primitive polynomial of degree s with middle coefficients a and the first direction integers m
// (m_i odd, below 2^i).
template <size_t S>
constexpr Directions direction_numbers(uint32_t a, const std::array<uint32_t, S>& m) {
    Directions v{};
    for (size_t i = 0; i < S; ++i) {
        v[i] = m[i] << (31U - i);
    }
    for (size_t i = S; i < v.size(); ++i) {
        v[i] = v[i - S] ^ (v[i - S] >> S);
        for (size_t k = 1; k < S; ++k) {
            v[i] ^= ((a >> (S - 1 - k)) & 1U) * v[i - k];
        }
    }
    return v;
}

constexpr Directions van_der_corput() {
    Directions v{};
    for (size_t i = 0; i < v.size(); ++i) {
        v[i] = 1U << (31U - i);
    }
    return v;
}

constexpr std::array<Directions, 3> k_directions = {van_der_corput(), direction_numbers<1>(0, {1}),
                                                    direction_numbers<2>(1, {1, 3})};

constexpr uint32_t reverse_bits(uint32_t x) {
    x = (x >> 16U) | (x << 16U);
    x = ((x & 0xff00ff00U) >> 8U) | ((x & 0x00ff00ffU) << 8U);
    x = ((x & 0xf0f0f0f0U) >> 4U) | ((x & 0x0f0f0f0fU) << 4U);
    x = ((x & 0xccccccccU) >> 2U) | ((x & 0x33333333U) << 2U);
    return ((x & 0xaaaaaaaaU) >> 1U) | ((x & 0x55555555U) << 1U);
}

// Nested uniform scrambling of a fraction's bits: each bit is flipped by a hash of the bits above it. On the
// reversed word that is a hash in which every bit depends on lower ones alone, as multiplication by even
// numbers and addition do.
constexpr uint32_t owen_scramble(uint32_t x, uint32_t seed) {
    x = reverse_bits(x);
    x ^= x * 0x3d20adeaU;
    x += seed;
    x *= (seed >> 16U) | 1U;
    x ^= x * 0x05526c56U;
    x ^= x * 0x53a22864U;
    return reverse_bits(x);
}

constexpr uint32_t hash(uint32_t x) {
    x ^= x >> 16U;
    x *= 0x7feb352dU;
    x ^= x >> 15U;
    x *= 0x846ca68bU;
    return x ^ (x >> 16U);
}

}  // namespace

glm::dvec3 sobol_point(uint32_t index, uint32_t seed) {
    glm::dvec3 point(0.0);
    for (size_t dimension = 0; dimension < 3; ++dimension) {
        uint32_t bits = 0;
        for (uint32_t rest = index, i = 0; rest != 0; rest >>= 1U, ++i) {
            if ((rest & 1U) != 0) {
                bits ^= k_directions[dimension][i];
            }
        }
        bits = owen_scramble(bits, hash(seed * 3U + static_cast<uint32_t>(dimension) + 1U));
        point[static_cast<int>(dimension)] = bits * 0x1p-32;
    }
    return point;
}

uint32_t numbered_seed(uint32_t seed, uint32_t number) {
    // A bijection of 32 bits, so that no two numbers share one (Wellons 2018, "Prospecting for Hash
    // Functions").
    uint32_t x = number;
    x ^= x >> 16U;
    x *= 0x7feb352dU;
    x ^= x >> 15U;
    x *= 0x846ca68bU;
    x ^= x >> 16U;
    return seed ^ x;
}

}  // namespace bounce::scene
