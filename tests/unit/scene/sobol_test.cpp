// SPDX-License-Identifier: Apache-2.0
//
// Stratification of the sequence that points are drawn by: what a (t, s)-net promises, counted box by box.
#include "scene/points/sobol.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace bounce::scene {
namespace {

constexpr uint32_t seeds[] = {0, 1, 2, 12345};

// Points of the block-th run of 2^bits, each as the cell it lies in where an axis is cut into 2^cut[axis]
// parts; how many each cell holds.
std::vector<int> counts_in_cells(uint32_t block, uint32_t bits, uint32_t seed, const glm::uvec3& cut) {
    std::vector<int> counts(size_t{1} << (cut.x + cut.y + cut.z), 0);
    for (uint32_t i = 0; i < (1U << bits); ++i) {
        const glm::dvec3 point = sobol_point((block << bits) + i, seed);
        size_t cell = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double value = point[axis];
            EXPECT_GE(value, 0.0);
            EXPECT_LT(value, 1.0);
            cell = (cell << cut[axis]) + static_cast<size_t>(value * static_cast<double>(1U << cut[axis]));
        }
        ++counts[cell];
    }
    return counts;
}

TEST(Sobol, EachBlockHasOnePointInEachStratumOfAnyAxis) {
    for (const uint32_t seed : seeds) {
        for (uint32_t bits = 0; bits <= 10; ++bits) {
            for (const uint32_t block : {0U, 1U, 2U, 5U, 37U, 4000U}) {
                for (int axis = 0; axis < 3; ++axis) {
                    glm::uvec3 cut(0U);
                    cut[axis] = bits;
                    for (const int count : counts_in_cells(block, bits, seed, cut)) {
                        ASSERT_EQ(count, 1) << "axis " << axis << ", block " << block << " of 2^" << bits;
                    }
                }
            }
        }
    }
}

TEST(Sobol, EachBlockIsANetOverPairsOfAxes) {
    // The first two dimensions are a (0, 2)-sequence: each of 2^k boxes, however long and thin, holds one
    // point. With the third, whose polynomial has degree 2, t = 1: each of 2^(k-1) boxes holds two.
    for (const uint32_t seed : seeds) {
        for (uint32_t bits = 1; bits <= 9; ++bits) {
            for (const uint32_t block : {0U, 1U, 6U, 1001U}) {
                for (uint32_t a = 0; a <= bits; ++a) {
                    for (const int count : counts_in_cells(block, bits, seed, {a, bits - a, 0})) {
                        ASSERT_EQ(count, 1) << a << " of " << bits << " bits in x, block " << block;
                    }
                }
                for (uint32_t a = 0; a < bits; ++a) {
                    for (const int count : counts_in_cells(block, bits, seed, {a, 0, bits - 1 - a})) {
                        ASSERT_EQ(count, 2) << a << " of " << bits << " bits in x, the rest in z";
                    }
                    for (const int count : counts_in_cells(block, bits, seed, {0, a, bits - 1 - a})) {
                        ASSERT_EQ(count, 2) << a << " of " << bits << " bits in y, the rest in z";
                    }
                }
            }
        }
    }
}

TEST(Sobol, EachBlockIsANetInTheCube) {
    for (uint32_t bits = 1; bits <= 8; ++bits) {
        for (uint32_t a = 0; a < bits; ++a) {
            for (uint32_t b = 0; a + b < bits; ++b) {
                for (const int count : counts_in_cells(3, bits, 1, {a, b, bits - 1 - a - b})) {
                    ASSERT_EQ(count, 2) << a << ' ' << b << " of " << bits;
                }
            }
        }
    }
}

TEST(Sobol, AnotherSeedIsAnotherSequence) {
    // Of two scramblings the first bits agree or differ throughout, so a pair may well look alike; over many
    // it must not: each point is uniform over seeds, and pairs are as often for as against each other.
    constexpr uint32_t many = 512;
    for (const uint32_t index : {0U, 1U, 77U}) {
        for (int axis = 0; axis < 3; ++axis) {
            std::vector<int> counts(8, 0);
            double product = 0.0;
            for (uint32_t seed = 0; seed < many; ++seed) {
                const double here = sobol_point(index, seed)[axis];
                ++counts[static_cast<size_t>(here * 8.0)];
                product += (here - 0.5) * (sobol_point(index, seed + 1)[axis] - 0.5) * 12.0 / many;
            }
            for (const int count : counts) {
                EXPECT_NEAR(count, 64, 32)
                    << "four standard deviations; index " << index << ", axis " << axis;
            }
            EXPECT_LT(std::abs(product), 4.0 / std::sqrt(many)) << "index " << index << ", axis " << axis;
        }
    }
    EXPECT_EQ(sobol_point(5, 1), sobol_point(5, 1)) << "the same input, the same point";
}

}  // namespace
}  // namespace bounce::scene
