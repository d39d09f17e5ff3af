// SPDX-License-Identifier: Apache-2.0
#include "renderer/light_samples.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "scene/points/sobol.h"

namespace bounce {
namespace {

constexpr double pi = std::numbers::pi;

// Seeds of the scrambling; any will do, but a picture should not change by chance.
constexpr uint32_t k_place_seed = 0x2545f491U;
constexpr uint32_t k_pixel_seed = 0x9e3779b9U;

glm::dvec2 disk_from_square(const glm::dvec2& u) {
    const glm::dvec2 p = 2.0 * u - 1.0;
    if (p.x == 0.0 && p.y == 0.0) {
        return p;
    }
    const bool wide = std::abs(p.x) > std::abs(p.y);
    const double radius = wide ? p.x : p.y;
    const double angle = wide ? 0.25 * pi * p.y / p.x : 0.5 * pi - 0.25 * pi * p.x / p.y;
    return radius * glm::dvec2(std::cos(angle), std::sin(angle));
}

// Of an increasing function on [low, high].
template <typename Function>
double solve(double value, double low, double high, Function&& function) {
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        (function(middle) < value ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

// The density 1 / sqrt(1 - r^2) of a ball projects to an even disk (its Abel transform is constant). With
// r = sin(f) the share within r is (f - sin f cos f) 2 / pi.
glm::dvec3 ball_from_cube(const glm::dvec3& u) {
    const double f =
        solve(u.z, 0.0, 0.5 * pi, [](double x) { return (x - std::sin(x) * std::cos(x)) * 2.0 / pi; });
    const double z = 1.0 - 2.0 * u.x;
    const double across = std::sqrt(std::max(1.0 - z * z, 0.0));
    const double angle = 2.0 * pi * u.y;
    return std::sin(f) * glm::dvec3(across * std::cos(angle), across * std::sin(angle), z);
}

// Blackman and Harris' window over three pixels, which is Cycles' filter of 1.5 px (passes/antialias.cpp).
double filter_place(double u) {
    return solve(u, -1.5, 1.5, [](double x) {
        const double t = x / 3.0 + 0.5;
        return t + (-0.48829 * std::sin(2.0 * pi * t) / (2.0 * pi) +
                    0.14128 * std::sin(4.0 * pi * t) / (4.0 * pi) -
                    0.01168 * std::sin(6.0 * pi * t) / (6.0 * pi)) /
                       0.35875;
    });
}

uint32_t reversed(uint32_t index, int bits) {
    uint32_t out = 0;
    for (int bit = 0; bit < bits; ++bit) {
        out |= ((index >> bit) & 1U) << (bits - 1 - bit);
    }
    return out;
}

}  // namespace

std::vector<glm::dvec3> light_samples(SampleShape shape, int count, uint32_t seed) {
    std::vector<glm::dvec3> out;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 u =
            scene::sobol_point(static_cast<uint32_t>(i), scene::numbered_seed(k_place_seed, seed));
        switch (shape) {
            case SampleShape::square:
                out.emplace_back(2.0 * glm::dvec2(u) - 1.0, 0.0);
                break;
            case SampleShape::disk:
                out.emplace_back(disk_from_square(glm::dvec2(u)), 0.0);
                break;
            case SampleShape::ball:
                out.push_back(ball_from_cube(u));
                break;
        }
    }
    return out;
}

std::vector<glm::dvec2> receiver_offsets(int count) {
    std::vector<glm::dvec2> out;
    const int bits = std::bit_width(static_cast<unsigned>(count)) - 1;
    for (int i = 0; i < count; ++i) {
        // In another order than the places: with the same one each part of the light would look at its own
        // part of the pixel.
        const uint32_t index = reversed(static_cast<uint32_t>(i), bits);
        const glm::dvec3 pixel = scene::sobol_point(index, k_pixel_seed);
        out.emplace_back(filter_place(pixel.x), filter_place(pixel.y));
    }
    return out;
}

}  // namespace bounce
