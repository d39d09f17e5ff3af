// SPDX-License-Identifier: Apache-2.0
#include "renderer/light_tints.h"

#include <gtest/gtest.h>

#include "renderer/light_samples.h"

namespace bounce {
namespace {

// From the lower left red, green, blue, white.
const scene::LightPattern k_quarters{2, 2, {{4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {0, 0, 0}}};

std::vector<glm::dvec2> places(SampleShape shape, int count) {
    const std::vector<glm::dvec3> samples = light_samples(shape, count);
    return {samples.begin(), samples.end()};
}

TEST(LightTints, FourPlacesHaveTheirQuarters) {
    const std::vector<glm::dvec2> four{{-0.5, -0.5}, {0.5, -0.5}, {-0.5, 0.5}, {0.5, 0.5}};
    const std::vector<glm::vec3> tints = light_tints(k_quarters, four, false);
    for (size_t i = 0; i < four.size(); ++i) {
        EXPECT_LT(glm::length(tints[i] - k_quarters.cells[i]), 1e-5F) << i;
    }
}

TEST(LightTints, TogetherSendWhatTheLightDoes) {
    for (const SampleShape shape : {SampleShape::square, SampleShape::disk}) {
        for (const int count : {8, 64, 512}) {
            glm::dvec3 mean(0.0);
            for (const glm::vec3& tint :
                 light_tints(k_quarters, places(shape, count), shape == SampleShape::disk)) {
                mean += glm::dvec3(tint) / static_cast<double>(count);
            }
            EXPECT_LT(glm::length(mean - glm::dvec3(1.0)), 1e-5) << count;
        }
    }
}

TEST(LightTints, AnEvenPatternIsOneEverywhere) {
    const scene::LightPattern even{1, 1, {{1, 1, 1}}};
    for (const glm::vec3& tint : light_tints(even, places(SampleShape::square, 64), false)) {
        EXPECT_EQ(tint, glm::vec3(1.0F));
    }
}

TEST(LightTints, AChannelThatIsDarkStaysDark) {
    const scene::LightPattern red{2, 1, {{2, 0, 0}, {0, 0, 0}}};
    for (const glm::vec3& tint : light_tints(red, places(SampleShape::disk, 64), true)) {
        EXPECT_TRUE(tint.r >= 0.0F && tint.g == 0.0F && tint.b == 0.0F);
    }
}

}  // namespace
}  // namespace bounce
