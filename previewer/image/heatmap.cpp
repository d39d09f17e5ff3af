// SPDX-License-Identifier: Apache-2.0
#include "image/heatmap.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace bounce {
namespace {

// Every 17th of matplotlib's 256 colours; straight lines between them stay within 0.01 of it.
constexpr size_t k_stops = 16;
const std::array<glm::vec3, k_stops> k_magma{{
    {0.0015F, 0.0005F, 0.0139F},
    {0.0438F, 0.0338F, 0.1419F},
    {0.1238F, 0.0673F, 0.2959F},
    {0.2321F, 0.0599F, 0.4377F},
    {0.3415F, 0.0806F, 0.4926F},
    {0.4452F, 0.1227F, 0.5069F},
    {0.5503F, 0.1612F, 0.5057F},
    {0.6585F, 0.1960F, 0.4903F},
    {0.7674F, 0.2337F, 0.4578F},
    {0.8688F, 0.2877F, 0.4093F},
    {0.9440F, 0.3776F, 0.3651F},
    {0.9810F, 0.4984F, 0.3697F},
    {0.9947F, 0.6243F, 0.4274F},
    {0.9972F, 0.7480F, 0.5169F},
    {0.9932F, 0.8700F, 0.6262F},
    {0.9871F, 0.9914F, 0.7495F},
}};

}  // namespace

Image magma(const Plane& values) {
    Image image(values.width, values.height);
    for (size_t i = 0; i < values.values.size(); ++i) {
        // NaN, which compares false, is shown as the largest error.
        const float value = values.values[i] < 1.0F ? std::max(values.values[i], 0.0F) : 1.0F;
        const float position = value * static_cast<float>(k_stops - 1);
        const auto below = std::min(static_cast<size_t>(position), k_stops - 2);
        const glm::vec3 color =
            glm::mix(k_magma[below], k_magma[below + 1], position - static_cast<float>(below));
        for (int channel = 0; channel < 3; ++channel) {
            image.rgb[3 * i + static_cast<size_t>(channel)] = color[channel];
        }
    }
    return image;
}

Plane relative_error(const Image& test, const Image& reference) {
    assert(test.width == reference.width && test.height == reference.height);
    Plane plane(test.width, test.height);
    for (size_t i = 0; i < plane.values.size(); ++i) {
        float sum = 0.0F;
        for (size_t channel = 0; channel < 3; ++channel) {
            const float b = reference.rgb[3 * i + channel];
            const float difference = test.rgb[3 * i + channel] - b;
            sum += difference * difference / (b * b + 0.01F);
        }
        plane.values[i] = std::sqrt(sum / 3.0F);
    }
    return plane;
}

Image magnified_difference(const Image& test_display, const Image& reference_display) {
    assert(test_display.width == reference_display.width && test_display.height == reference_display.height);
    Image image(test_display.width, test_display.height);
    for (size_t i = 0; i < image.rgb.size(); ++i) {
        image.rgb[i] = std::min(4.0F * std::abs(test_display.rgb[i] - reference_display.rgb[i]), 1.0F);
    }
    return image;
}

}  // namespace bounce
