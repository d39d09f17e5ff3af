// SPDX-License-Identifier: Apache-2.0
#include "renderer/light_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace bounce {
namespace {

constexpr int k_count = 64;

// Largest difference between the share of samples below a place along a direction and the shape's own share.
template <typename Share>
double discrepancy(const std::vector<glm::dvec3>& samples, const glm::dvec3& direction, Share&& share) {
    std::vector<double> places;
    for (const glm::dvec3& p : samples) {
        places.push_back(glm::dot(p, direction));
    }
    std::sort(places.begin(), places.end());
    double worst = 0.0;
    for (size_t i = 0; i < places.size(); ++i) {
        const double expected = share(places[i]);
        const auto count = static_cast<double>(places.size());
        worst = std::max({worst, std::abs(static_cast<double>(i) / count - expected),
                          std::abs(static_cast<double>(i + 1) / count - expected)});
    }
    return worst;
}

double disk_share(double u) {
    return 1.0 - (std::acos(std::clamp(u, -1.0, 1.0)) - u * std::sqrt(std::max(1.0 - u * u, 0.0))) /
                     std::numbers::pi;
}

// An edge that crosses the light at any angle hides nearly the share of the samples that it hides of the
// light: within two of 64 across a square's sides, where the samples are stratified, and within five at any
// angle of a disk. Independent samples would be off by ten (Kolmogorov's 1.22 / sqrt(64) at 10 %).
TEST(LightSamples, AnEdgeHidesItsShareOfEachShape) {
    const std::vector<glm::dvec3> square = light_samples(SampleShape::square, k_count);
    EXPECT_LT(discrepancy(square, {1, 0, 0}, [](double x) { return 0.5 * (x + 1.0); }), 2.0 / k_count);
    EXPECT_LT(discrepancy(square, {0, 1, 0}, [](double x) { return 0.5 * (x + 1.0); }), 2.0 / k_count);
    const std::vector<glm::dvec3> disk = light_samples(SampleShape::disk, k_count);
    for (int i = 0; i < 16; ++i) {
        const double angle = i * std::numbers::pi / 16.0;
        EXPECT_LT(discrepancy(disk, {std::cos(angle), std::sin(angle), 0.0}, disk_share), 5.0 / k_count) << i;
    }
}

TEST(LightSamples, TheBallIsAnEvenDiskFromEverywhere) {
    const std::vector<glm::dvec3> ball = light_samples(SampleShape::ball, k_count);
    for (const glm::dvec3& direction :
         {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::normalize(glm::dvec3(1, 1, 1)),
          glm::normalize(glm::dvec3(-1, 2, 1))}) {
        EXPECT_LT(discrepancy(ball, direction, disk_share), 6.0 / k_count);
    }
    // The disk's second moment, 1/2 over both axes, seen along z; by many samples to a percent.
    double sum = 0.0;
    for (const glm::dvec3& p : light_samples(SampleShape::ball, 4096)) {
        sum += p.x * p.x + p.y * p.y;
    }
    EXPECT_NEAR(sum / 4096, 0.5, 0.005);
}

TEST(LightSamples, StayWithinTheShape) {
    for (const glm::dvec3& p : light_samples(SampleShape::disk, 256)) {
        EXPECT_LE(glm::length(p), 1.0);
        EXPECT_EQ(p.z, 0.0);
    }
    for (const glm::dvec3& p : light_samples(SampleShape::ball, 256)) {
        EXPECT_LE(glm::length(p), 1.0);
    }
}

TEST(LightSamples, EachRunOfEightIsSpreadByItself) {
    // A dispatch has eight of them, and a pixel of the probe no others.
    const std::vector<glm::dvec3> square = light_samples(SampleShape::square, k_count);
    for (int first = 0; first < k_count; first += 8) {
        const std::vector<glm::dvec3> run(square.begin() + first, square.begin() + first + 8);
        EXPECT_LT(discrepancy(run, {1, 0, 0}, [](double x) { return 0.5 * (x + 1.0); }), 2.0 / 8) << first;
    }
}

TEST(ReceiverOffsets, HaveThePixelFiltersMeanAndWidth) {
    const std::vector<glm::dvec2> offsets = receiver_offsets(1024);
    glm::dvec2 mean(0.0);
    double square = 0.0;
    for (const glm::dvec2& offset : offsets) {
        mean += offset;
        square += offset.x * offset.x;
        EXPECT_LE(std::abs(offset.x), 1.5);
    }
    // Variance of the window 0.35875 + 0.48829 cos + 0.14128 cos 2 + 0.01168 cos 3 over three pixels, by its
    // Fourier coefficients: (3 / (2 pi))^2 (pi^2 / 3 + 2/a0 (-a1 + a2/4 - a3/9)).
    const double variance =
        std::pow(1.5 / std::numbers::pi, 2) *
        (std::pow(std::numbers::pi, 2) / 3.0 + 2.0 / 0.35875 * (-0.48829 + 0.14128 / 4.0 - 0.01168 / 9.0));
    EXPECT_NEAR(mean.x / 1024, 0.0, 0.01);
    EXPECT_NEAR(mean.y / 1024, 0.0, 0.01);
    EXPECT_NEAR(square / 1024, variance, 0.02 * variance);
}

}  // namespace
}  // namespace bounce
