// SPDX-License-Identifier: Apache-2.0
//
// Lights that stand for an image of the world: all of its light, from where it comes.
#include "renderer/environment_lights.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "scene/environment.h"

namespace bounce {
namespace {

constexpr double pi = std::numbers::pi;

scene::Environment image_of(int width, int height, const std::function<glm::dvec3(int, int)>& radiance) {
    scene::Environment image{"test", width, height, {}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const glm::vec3 c(radiance(x, y));
            image.rgb.insert(image.rgb.end(), {c.r, c.g, c.b});
        }
    }
    return image;
}

scene::Environment random_image(int width, int height, unsigned seed) {
    std::mt19937 random(seed);
    std::exponential_distribution<double> light(1.0);
    return image_of(width, height,
                    [&](int, int) { return glm::dvec3(light(random), light(random), light(random)); });
}

// As a function of direction, of an image fine enough to hold it.
scene::Environment image_by(const std::function<glm::dvec3(const glm::dvec3&)>& radiance, int width = 512) {
    return image_of(width, width / 2, [&](int x, int y) {
        return radiance(scene::environment_direction((x + 0.5) / width, (y + 0.5) / (width / 2)));
    });
}

// The integral over the sphere of the image as it is interpolated, by 1,000 x 500 places or more.
glm::dvec3 whole_light(const scene::Environment& image) {
    const int fine_x = image.width * std::max(1, 1000 / image.width);
    const int fine_y = image.height * std::max(1, 500 / image.height);
    glm::dvec3 sum(0.0);
    for (int y = 0; y < fine_y; ++y) {
        for (int x = 0; x < fine_x; ++x) {
            const double u = (x + 0.5) / fine_x * image.width - 0.5;
            const double v = (y + 0.5) / fine_y * image.height - 0.5;
            for (int k = 0; k < 4; ++k) {
                const double i = std::floor(u) + k % 2;
                const double j = std::floor(v) + k / 2;
                const double weight = (1.0 - std::abs(u - i)) * (1.0 - std::abs(v - j));
                const auto column =
                    static_cast<size_t>(((static_cast<int>(i) % image.width) + image.width) % image.width);
                const auto row = static_cast<size_t>(std::clamp(static_cast<int>(j), 0, image.height - 1));
                const float* rgb = &image.rgb[3 * (row * static_cast<size_t>(image.width) + column)];
                sum += weight * scene::environment_texel_sr(fine_x, fine_y, y) *
                       glm::dvec3(rgb[0], rgb[1], rgb[2]);
            }
        }
    }
    return sum;
}

glm::dvec3 light_of(const EnvironmentLights& lights, const std::vector<EnvironmentRegion>& regions) {
    glm::dvec3 sum(0.0);
    for (const EnvironmentRegion& region : regions) {
        sum += region.irradiance;
    }
    for (const EnvironmentSun& sun : lights.suns()) {
        sum += sun.irradiance;
    }
    return sum;
}

double irradiance(const EnvironmentLights& lights, int count, const glm::dvec3& normal) {
    double sum = 0.0;
    for (const EnvironmentRegion& region : lights.regions(count)) {
        sum += region.irradiance.g * std::max(glm::dot(region.from, normal), 0.0);
    }
    for (const EnvironmentSun& sun : lights.suns()) {
        sum += sun.irradiance.g * std::max(glm::dot(sun.from, normal), 0.0);
    }
    return sum;
}

TEST(EnvironmentLights, HaveAllOfTheImagesLight) {
    const std::vector<scene::Environment> images{
        random_image(1, 1, 1),
        random_image(2, 1, 2),
        random_image(37, 19, 3),
        random_image(64, 32, 4),
        random_image(1000, 501, 5),
        image_of(64, 32, [](int x, int y) { return x == 20 && y == 9 ? glm::dvec3(1e6) : glm::dvec3(0.01); }),
        image_of(
            1024, 512,
            [](int x, int y) { return x == 20 && y == 9 ? glm::dvec3(1e6, 1e5, 10.0) : glm::dvec3(1.0); }),
        image_of(128, 64, [](int, int) { return glm::dvec3(0.0); }),
    };
    for (const scene::Environment& image : images) {
        const EnvironmentLights lights(image);
        const glm::dvec3 all = whole_light(image);
        for (const int count : {16, 240, 256, 1000}) {
            const std::vector<EnvironmentRegion> regions = lights.regions(count);
            ASSERT_EQ(regions.size(), static_cast<size_t>(count));
            const glm::dvec3 found = light_of(lights, regions);
            double solid_angle = 0.0;
            for (int c = 0; c < 3; ++c) {
                // 1e-3: this sum and theirs interpolate small images at other places.
                EXPECT_NEAR(found[c], all[c], 1e-3 * all[c])
                    << image.width << " x " << image.height << ", " << count;
            }
            for (const EnvironmentRegion& region : regions) {
                EXPECT_NEAR(glm::length(region.from), 1.0, 1e-9);
                EXPECT_GE(std::min({region.irradiance.r, region.irradiance.g, region.irradiance.b}), 0.0);
                solid_angle += region.solid_angle;
            }
            EXPECT_GE(solid_angle, 4.0 * pi * 0.999) << "every direction is in a region";
        }
    }
}

TEST(EnvironmentLights, GiveAPlaneItsIrradianceWhicheverWayItFaces) {
    // An even image, pi; one that falls off as cos from the top, 2 pi / 3 from above and none from below; a
    // soft patch, radiance exp(20 (cos - 1)) about a slanted direction, whose integral is 2 pi / 20 (1 -
    // exp(-40)). 1 %: 256 lights.
    const EnvironmentLights even(image_by([](const glm::dvec3&) { return glm::dvec3(1.0); }));
    const EnvironmentLights cosine(
        image_by([](const glm::dvec3& d) { return glm::dvec3(std::max(d.y, 0.0)); }));
    const glm::dvec3 to_patch = glm::normalize(glm::dvec3(0.6, 0.5, -0.7));
    const EnvironmentLights patch(image_by(
        [&](const glm::dvec3& d) { return glm::dvec3(std::exp(20.0 * (glm::dot(d, to_patch) - 1.0))); }));
    for (int i = 0; i < 30; ++i) {
        const double z = 1.0 - 2.0 * (i + 0.5) / 30.0;
        const double phi = i * 2.399963;
        const double r = std::sqrt(1.0 - z * z);
        const glm::dvec3 normal(r * std::cos(phi), r * std::sin(phi), z);
        EXPECT_NEAR(irradiance(even, 256, normal) / pi, 1.0, 0.01) << i;
    }
    EXPECT_NEAR(irradiance(cosine, 256, {0, 1, 0}) / (2.0 * pi / 3.0), 1.0, 0.01);
    EXPECT_NEAR(irradiance(cosine, 256, {0, -1, 0}), 0.0, 0.01);
    // Facing it, the integral of exp(20 (c - 1)) c: 2 pi (1 / 20 - 1 / 400).
    EXPECT_NEAR(irradiance(patch, 256, to_patch) / (2.0 * pi * (1.0 / 20.0 - 1.0 / 400.0)), 1.0, 0.01);
}

TEST(EnvironmentLights, ASunIsTakenOutOfTheImage) {
    // Half a degree wide, 1e5 times as bright as the sky, between texels and across the seam of the image.
    const glm::dvec3 from = glm::normalize(glm::dvec3(-0.8, 0.6, 0.001));
    const double radius = 0.5 * 0.53 * pi / 180.0;
    const double step = pi / 1024.0;
    const EnvironmentLights lights(image_by(
        [&](const glm::dvec3& d) {
            const double angle = std::acos(std::min(glm::dot(d, from), 1.0));
            // Its rim is as soft as a texel.
            return glm::dvec3(1.0) + 1e5 * std::clamp((radius - angle) / step + 0.5, 0.0, 1.0);
        },
        2048));
    ASSERT_EQ(lights.suns().size(), 1U);
    const EnvironmentSun& sun = lights.suns()[0];
    EXPECT_LT(std::acos(std::min(glm::dot(sun.from, from), 1.0)), 0.03 * pi / 180.0);
    EXPECT_NEAR(sun.irradiance.g / (1e5 * pi * radius * radius), 1.0, 0.1);
    EXPECT_NEAR(sun.angle_rad / (2.0 * radius), 1.0, 0.25);
    for (const EnvironmentRegion& region : lights.regions(240)) {
        EXPECT_NEAR(region.irradiance.g / region.solid_angle, 1.0, 0.01) << "nothing of it is left";
    }
}

TEST(EnvironmentLights, AWindowIsNoSun) {
    const glm::dvec3 from = glm::normalize(glm::dvec3(0.5, 0.3, 0.4));
    const EnvironmentLights lights(image_by(
        [&](const glm::dvec3& d) { return glm::dvec3(glm::dot(d, from) > std::cos(0.2) ? 50.0 : 0.1); },
        1024));
    EXPECT_TRUE(lights.suns().empty());
}

TEST(EnvironmentLights, EachInterleavedPartHasItsShare) {
    // Half of the light from one twentieth of a degree's worth of a coarse image: one light alone would leave
    // 15 of 16 pixels without it.
    const EnvironmentLights lights(image_of(
        64, 32, [](int x, int y) { return x == 20 && y == 9 ? glm::dvec3(2000.0) : glm::dvec3(1.0); }));
    Settings settings;
    settings.world_vpls = 256;
    const IsmLayout layout = world_layout(settings, 0);
    const std::vector<EnvironmentRegion> regions = lights.regions(environment_region_count(lights, layout));
    const std::vector<gpu::GpuVpl> vpls =
        environment_vpls(lights, regions, glm::dmat3(1.0), 2.0, layout, {{}, 1.0F});
    ASSERT_EQ(vpls.size(), static_cast<size_t>(layout.vpls));
    double all = 0.0;
    std::vector<double> parts;
    for (int i = 0; i < layout.vpls; ++i) {
        if (i % layout.subset == 0) {
            parts.push_back(0.0);
        }
        parts.back() += static_cast<double>(vpls[static_cast<size_t>(i)].intensity.g);
        all += static_cast<double>(vpls[static_cast<size_t>(i)].intensity.g);
    }
    EXPECT_NEAR(all / (2.0 * light_of(lights, regions).g), 1.0, 1e-5) << "strength";
    for (const double part : parts) {
        EXPECT_NEAR(part * 16.0 / all, 1.0, 0.35);
    }
}

TEST(EnvironmentLights, TurnWithTheImage) {
    const EnvironmentLights lights(random_image(64, 32, 9));
    Settings settings;
    settings.world_vpls = 64;
    const IsmLayout layout = world_layout(settings, 0);
    const std::vector<EnvironmentRegion> regions = lights.regions(64);
    const glm::dmat3 turn = glm::mat3_cast(glm::normalize(glm::dquat(0.9, 0.1, 0.3, -0.2)));
    const auto still = environment_vpls(lights, regions, glm::dmat3(1.0), 1.0, layout, {{}, 1.0F});
    const auto turned = environment_vpls(lights, regions, turn, 1.0, layout, {{}, 1.0F});
    for (size_t i = 0; i < still.size(); ++i) {
        for (const auto axis : {&gpu::GpuVpl::normal, &gpu::GpuVpl::tangent, &gpu::GpuVpl::bitangent}) {
            const glm::dvec3 expected = turn * glm::dvec3(glm::vec3(still[i].*axis));
            EXPECT_LT(glm::length(glm::dvec3(glm::vec3(turned[i].*axis)) - expected), 1e-5);
        }
        EXPECT_EQ(still[i].intensity, turned[i].intensity);
    }
}

}  // namespace
}  // namespace bounce
