// SPDX-License-Identifier: Apache-2.0
#include "passes/rsm_pattern.h"

#include <cmath>
#include <numbers>

namespace bounce::passes {
namespace {

// Innermost radius of the log-uniform pattern: inside it, one part in 2,500 of the disk, nothing is
// sampled; smaller would spend more of the samples where hardly any flux is.
constexpr double k_inner_radius = 0.02;

}  // namespace

std::vector<glm::vec4> make_rsm_pattern(RsmPattern kind, int samples) {
    std::vector<glm::vec4> points;
    double total = 0.0;
    for (int i = 0; i < samples; ++i) {
        const double t = (i + 0.5) / samples;
        const double angle = 2.0 * std::numbers::pi * std::fmod(i * (std::numbers::phi - 1.0), 1.0);
        const double radius = kind == RsmPattern::inverse_square ? std::pow(k_inner_radius, 1.0 - t) : t;
        const double weight = kind == RsmPattern::uniform_radius ? radius : radius * radius;
        total += weight;
        points.emplace_back(std::cos(angle), std::sin(angle), radius, weight);
    }
    for (glm::vec4& point : points) {
        point.w = static_cast<float>(point.w * std::numbers::pi / total);
    }
    return points;
}

}  // namespace bounce::passes
