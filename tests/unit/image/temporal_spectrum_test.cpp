// SPDX-License-Identifier: Apache-2.0
#include "image/temporal_spectrum.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace bounce {
namespace {

constexpr size_t k_frames = 16;

template <typename Function>
std::vector<double> signal(size_t frames, const Function& of_frame) {
    std::vector<double> values;
    for (size_t t = 0; t < frames; ++t) {
        values.push_back(of_frame(static_cast<double>(t)));
    }
    return values;
}

double wave(double t, double cycles) {
    return std::cos(2.0 * std::numbers::pi * cycles * t / static_cast<double>(k_frames));
}

// +a, -a, ...: the mean of the squares is a^2, and all of it has a period of two frames.
TEST(TemporalSpectrum, AlternatingByHand) {
    for (const size_t frames : {8U, 9U, 16U, 25U}) {
        const auto values =
            signal(frames, [](double t) { return std::fmod(t, 2.0) < 0.5 ? 3.3 : 2.7; });  // 3 +- 0.3
        const TemporalEnergy energy = temporal_energy(values);
        // An odd count has a mean beside 3 and no frequency of exactly a half.
        const double tolerance = frames % 2 == 0 ? 1e-12 : 2e-3;
        EXPECT_NEAR(energy.high, 0.09, tolerance) << frames;
        EXPECT_NEAR(energy.total, 0.09, tolerance) << frames;
    }
}

// A cosine's mean square is 1/2. The window spreads it over its neighbours alone: 2 of 16 frames is slow,
// 6 is fast, and of 4, a quarter of a cycle a frame, the part at 5 is above the limit: the window's
// amplitudes are 1/4, 1/2, 1/4, so its energies 1/6, 4/6, 1/6.
TEST(TemporalSpectrum, CosinesByHand) {
    const auto energy = [](double cycles) {
        return temporal_energy(signal(k_frames, [=](double t) { return wave(t, cycles); }));
    };
    EXPECT_NEAR(energy(2).high, 0.0, 1e-12);
    EXPECT_NEAR(energy(2).total, 0.5, 1e-12);
    EXPECT_NEAR(energy(6).high, 0.5, 1e-12);
    EXPECT_NEAR(energy(6).total, 0.5, 1e-12);
    EXPECT_NEAR(energy(4).high, 0.5 / 6.0, 1e-12);
    // Of 1 frequency 0 gets a part, which does not count: at +-1 amplitudes of 1/4, at +-2 of 1/8, over the
    // window's mean square of 3/8.
    EXPECT_NEAR(energy(1).total, (2.0 / 16.0 + 2.0 / 64.0) / (3.0 / 8.0), 1e-12);
}

TEST(TemporalSpectrum, WhatStandsStillHasNothing) {
    const TemporalEnergy energy = temporal_energy(std::vector<double>(k_frames, 0.1));
    EXPECT_EQ(energy.high, 0.0);
    EXPECT_EQ(energy.total, 0.0);
}

// Light that rises evenly is no flicker: of the energy of 16 frames 0.023 % is fast. Without a window it
// would be 9.8 %.
TEST(TemporalSpectrum, ARampIsSlow) {
    const TemporalEnergy energy = temporal_energy(signal(k_frames, [](double t) { return t; }));
    EXPECT_GT(energy.total, 1.0);
    EXPECT_LT(energy.high, 5e-4 * energy.total);
}

// White noise has as much energy at every frequency: of the 15 beside 0 seven are in the high half.
TEST(TemporalSpectrum, NoiseIsSharedOutEvenly) {
    std::mt19937 random(1);
    std::normal_distribution<float> noise(0.0F, 0.5F);
    std::vector<Plane> frames;
    for (size_t t = 0; t < k_frames; ++t) {
        frames.emplace_back(100, 100);
        for (float& value : frames.back().values) {
            value = noise(random);
        }
    }
    const TemporalEnergy energy = mean_temporal_energy(frames, {});
    // 10,000 pixels: the figures' own deviation is below 0.5 %, this is six times that.
    EXPECT_NEAR(energy.high, 0.25 * 7.0 / 16.0, 0.03 * 0.25 * 7.0 / 16.0);
}

TEST(TemporalSpectrum, PixelsAreAveragedAndMaskedOnesLeftOut) {
    std::vector<Plane> frames;
    for (size_t t = 0; t < k_frames; ++t) {
        frames.emplace_back(2, 1);
        frames.back().values = {t % 2 == 0 ? 1.0F : -1.0F, 5.0F};
    }
    EXPECT_NEAR(mean_temporal_energy(frames, {}).high, 0.5, 1e-12);
    EXPECT_NEAR(mean_temporal_energy(frames, {1, 0}).high, 1.0, 1e-12);
    EXPECT_EQ(mean_temporal_energy(frames, {0, 1}).high, 0.0);
    EXPECT_TRUE(std::isnan(mean_temporal_energy(frames, {0, 0}).high)) << "of nothing";
    frames[3].values[1] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(std::isnan(mean_temporal_energy(frames, {}).high));
    frames.resize(k_least_spectrum_frames - 1);
    EXPECT_TRUE(std::isnan(mean_temporal_energy(frames, {}).total)) << "too few";
}

}  // namespace
}  // namespace bounce
