// SPDX-License-Identifier: Apache-2.0
#include "renderer/light_tints.h"

#include <algorithm>
#include <cmath>

namespace bounce {
namespace {

// Looked up along each side of the light; two for each cell of the finest pattern.
constexpr int k_steps = 32;

const glm::vec3& cell(const scene::LightPattern& pattern, const glm::dvec2& p) {
    const auto along = [](double x, int cells) {
        return std::clamp(static_cast<int>(std::floor((0.5 * x + 0.5) * cells)), 0, cells - 1);
    };
    return pattern
        .cells[static_cast<size_t>(along(p.y, pattern.height) * pattern.width + along(p.x, pattern.width))];
}

size_t nearest(std::span<const glm::dvec2> places, const glm::dvec2& p) {
    const auto distance = [&](const glm::dvec2& place) { return glm::dot(place - p, place - p); };
    const auto found =
        std::min_element(places.begin(), places.end(),
                         [&](const glm::dvec2& a, const glm::dvec2& b) { return distance(a) < distance(b); });
    return static_cast<size_t>(found - places.begin());
}

}  // namespace

std::vector<glm::vec3> light_tints(const scene::LightPattern& pattern, std::span<const glm::dvec2> places,
                                   bool round) {
    std::vector<glm::dvec3> sums(places.size(), glm::dvec3(0.0));
    std::vector<int> counts(places.size(), 0);
    for (int y = 0; y < k_steps; ++y) {
        for (int x = 0; x < k_steps; ++x) {
            const glm::dvec2 p = 2.0 * (glm::dvec2(x, y) + 0.5) / static_cast<double>(k_steps) - 1.0;
            if (round && glm::dot(p, p) > 1.0) {
                continue;
            }
            const size_t place = nearest(places, p);
            sums[place] += glm::dvec3(cell(pattern, p));
            ++counts[place];
        }
    }
    glm::dvec3 mean(0.0);
    for (size_t i = 0; i < places.size(); ++i) {
        // Between the steps there may be a place without one.
        sums[i] =
            counts[i] > 0 ? sums[i] / static_cast<double>(counts[i]) : glm::dvec3(cell(pattern, places[i]));
        mean += sums[i] / static_cast<double>(places.size());
    }
    std::vector<glm::vec3> tints;
    for (const glm::dvec3& sum : sums) {
        // All count alike, however much of the light each stands for: what that adds is taken off again.
        tints.emplace_back(glm::vec3(mean.r > 0.0 ? sum.r / mean.r : 0.0, mean.g > 0.0 ? sum.g / mean.g : 0.0,
                                     mean.b > 0.0 ? sum.b / mean.b : 0.0));
    }
    return tints;
}

}  // namespace bounce
