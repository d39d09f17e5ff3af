// SPDX-License-Identifier: Apache-2.0
//
// Lights that stand for the world: how much of it, from where.
#include "renderer/world_lights.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace bounce {
namespace {

constexpr double pi = std::numbers::pi;

IsmLayout layout_of(int lights) {
    Settings settings;
    settings.world_vpls = lights;
    return world_layout(settings, 0);
}

TEST(WorldLights, TogetherAreTheWholeSphere) {
    for (const int count : {16, 256, 1000}) {
        const IsmLayout layout = layout_of(count);
        const auto lights = world_lights({0.5F, 1.0F, 2.0F}, layout, {{0.1F, 0.2F, 0.3F}, 0.4F});
        ASSERT_EQ(lights.size(), static_cast<size_t>(layout.vpls));
        double solid_angle = 0.0;
        glm::dvec3 light(0.0);
        glm::dvec3 mean(0.0);
        for (const gpu::GpuVpl& l : lights) {
            solid_angle += static_cast<double>(l.position.w);
            light += glm::dvec3(l.intensity);
            mean += glm::dvec3(l.normal);
            EXPECT_EQ(glm::vec3(l.position), glm::vec3(0.1F, 0.2F, 0.3F));
            EXPECT_EQ(l.tangent.w, 0.4F);
            // Axes of its map: square to each other and right-handed.
            EXPECT_NEAR(glm::length(glm::vec3(l.normal)), 1.0, 1e-5);
            EXPECT_NEAR(
                glm::length(glm::cross(glm::vec3(l.tangent), glm::vec3(l.bitangent)) - glm::vec3(l.normal)),
                0.0, 1e-5);
        }
        EXPECT_NEAR(solid_angle / (4.0 * pi), 1.0, 1e-5);
        EXPECT_NEAR(light.x / (4.0 * pi * 0.5), 1.0, 1e-5);
        EXPECT_NEAR(light.z / (4.0 * pi * 2.0), 1.0, 1e-5);
        EXPECT_LT(glm::length(mean) / count, 0.5 / std::sqrt(count)) << "no side is preferred";
    }
}

TEST(WorldLights, GiveAPlaneItsIrradianceWhicheverWayItFaces) {
    // pi times the radiance; random directions would be off by 1 / sqrt(N) = 6 %.
    const auto lights = world_lights(glm::vec3(1.0F), layout_of(256), {{}, 1.0F});
    for (int i = 0; i < 50; ++i) {
        const double z = 1.0 - 2.0 * (i + 0.5) / 50.0;
        const double phi = i * 2.399963;
        const glm::dvec3 normal(std::sqrt(1.0 - z * z) * std::cos(phi),
                                std::sqrt(1.0 - z * z) * std::sin(phi), z);
        double sum = 0.0;
        for (const gpu::GpuVpl& l : lights) {
            sum += static_cast<double>(l.intensity.x) *
                   std::max(-glm::dot(normal, glm::dvec3(glm::vec3(l.normal))), 0.0);
        }
        EXPECT_NEAR(sum / pi, 1.0, 0.01) << i;
    }
}

TEST(WorldLights, EachInterleavedPartIsSpreadOverTheSphere) {
    // 16 lights that a pixel gathers from: two in each octant in the mean, and none without.
    const IsmLayout layout = layout_of(256);
    const auto lights = world_lights(glm::vec3(1.0F), layout, {{}, 1.0F});
    for (int part = 0; part < layout.vpls / layout.subset; ++part) {
        int octants[8] = {};
        for (int i = 0; i < layout.subset; ++i) {
            const glm::vec4& n = lights[static_cast<size_t>(part * layout.subset + i)].normal;
            ++octants[(n.x > 0.0F ? 1 : 0) + (n.y > 0.0F ? 2 : 0) + (n.z > 0.0F ? 4 : 0)];
        }
        for (const int count : octants) {
            EXPECT_GE(count, 1) << part;
            EXPECT_LE(count, 4) << part;
        }
    }
}

}  // namespace
}  // namespace bounce
