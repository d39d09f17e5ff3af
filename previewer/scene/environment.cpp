// SPDX-License-Identifier: Apache-2.0
#include "scene/environment.h"

#include <cmath>
#include <numbers>

namespace bounce::scene {

glm::dvec3 environment_direction(double u, double v) {
    const double azimuth = 2.0 * std::numbers::pi * (u - 0.5);
    const double polar = std::numbers::pi * v;
    const double r = std::sin(polar);
    return {r * std::cos(azimuth), std::cos(polar), r * std::sin(azimuth)};
}

double environment_texel_sr(int width, int height, int y) {
    const double step = std::numbers::pi / height;
    return 2.0 * std::numbers::pi / width * (std::cos(step * y) - std::cos(step * (y + 1)));
}

glm::vec3 mean_radiance(const Environment& environment) {
    const auto width = static_cast<size_t>(environment.width);
    glm::dvec3 sum(0.0);
    for (int y = 0; y < environment.height; ++y) {
        glm::dvec3 row(0.0);
        const float* texels = &environment.rgb[static_cast<size_t>(y) * width * 3];
        for (size_t x = 0; x < width; ++x) {
            row += glm::dvec3(texels[3 * x], texels[3 * x + 1], texels[3 * x + 2]);
        }
        sum += row * environment_texel_sr(environment.width, environment.height, y);
    }
    return glm::vec3(sum / (4.0 * std::numbers::pi));
}

}  // namespace bounce::scene
