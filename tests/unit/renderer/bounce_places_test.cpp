// SPDX-License-Identifier: Apache-2.0
//
// Places on a large area light: where they lie, what each sends, which lights have any.
#include "renderer/bounce_places.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace bounce {
namespace {

scene::Light area(float x, float y, scene::AreaShape shape = scene::AreaShape::rectangle) {
    scene::Light light;
    light.name = "Tube";
    light.type = scene::LightType::area;
    light.power_w = 12.0F;
    light.size_x_m = x;
    light.size_y_m = y;
    light.shape = shape;
    return light;
}

scene::Bounds room() {
    scene::Bounds bounds;
    bounds.grow(glm::dvec3(-5.0));
    bounds.grow(glm::dvec3(5.0));
    return bounds;
}

LightSetup set_up(const scene::Light& light) {
    return set_up_light({0, 0, glm::dmat4(1.0)}, light, room(), {}, 256, 512);
}

TEST(BouncePlaces, AreTheLightItselfWhereThereIsOne) {
    const LightSetup light = set_up(area(2.0F, 1.0F));
    const std::vector<LightSetup> one = bounce_places(light, 1);
    ASSERT_EQ(one.size(), 1U);
    EXPECT_EQ(one[0].name, "Tube");
    EXPECT_EQ(one[0].gpu.position, light.gpu.position);
    EXPECT_EQ(one[0].gpu.intensity, light.gpu.intensity);
    EXPECT_EQ(one[0].gpu.map, light.gpu.map);
}

TEST(BouncePlaces, IntegrateCubicsOverTheLight) {
    for (const int count : {2, 4, 8, 16}) {
        for (const glm::vec2 size : {glm::vec2(2.0F, 2.0F), glm::vec2(8.0F, 0.5F), glm::vec2(1.0F, 1.6F)}) {
            for (const auto shape : {scene::AreaShape::rectangle, scene::AreaShape::ellipse}) {
                const LightSetup light = set_up(area(size.x, size.y, shape));
                glm::dvec2 mean(0.0);
                glm::dvec2 square(0.0);
                double power = 0.0;
                for (const LightSetup& place : bounce_places(light, count)) {
                    const glm::dvec3 d(glm::vec3(place.gpu.position - light.gpu.position));
                    EXPECT_NEAR(d.z, 0.0, 1e-6);
                    const glm::dvec2 at(d.x / (0.5 * size.x), d.y / (0.5 * size.y));
                    EXPECT_LE(shape == scene::AreaShape::ellipse ? glm::length(at)
                                                                 : std::max(std::abs(at.x), std::abs(at.y)),
                              1.0);
                    mean += at / static_cast<double>(count);
                    square += at * at / static_cast<double>(count);
                    power += static_cast<double>(place.gpu.intensity.x);
                }
                EXPECT_NEAR(glm::length(mean), 0.0, 1e-6);
                EXPECT_NEAR(power, static_cast<double>(light.gpu.intensity.x), 1e-5);
                // Of the whole 1/3, of an ellipse 1/4; 0 across, where all lie in one row.
                const double whole = shape == scene::AreaShape::ellipse ? 0.25 : 1.0 / 3.0;
                for (int axis = 0; axis < 2; ++axis) {
                    EXPECT_TRUE(std::abs(square[axis] - whole) < 1e-6 || square[axis] < 1e-12)
                        << count << " " << size.x << " " << square[axis];
                }
                EXPECT_NEAR(square[size.x > size.y ? 0 : 1], whole, 1e-6) << "along the longer side";
            }
        }
    }
}

TEST(BouncePlaces, SeeFromWhereTheyAre) {
    for (const LightSetup& place : bounce_places(set_up(area(2.0F, 2.0F)), 4)) {
        EXPECT_EQ(place.name.substr(0, 12), "Tube, place ");
        EXPECT_EQ(place.gpu.map.x, 64.0F) << "half of a cube's face of 128";
        EXPECT_NEAR(place.flux_w, set_up(area(2.0F, 2.0F)).flux_w / 4.0, 1e-9);
        // A point straight before it is in the middle of the face along its axis.
        const glm::vec4 before = place.gpu.position + glm::vec4(glm::vec3(place.gpu.axis), 1.0F);
        const glm::vec4 clip = place.faces[4].clip_from_render * before;
        EXPECT_NEAR(clip.x / clip.w, 0.0F, 1e-6F);
        EXPECT_NEAR(clip.y / clip.w, 0.0F, 1e-6F);
        EXPECT_NEAR(clip.w, 1.0F, 1e-6F);
    }
}

TEST(BouncePlaces, AreForLargeAreaLights) {
    const auto count = [](const scene::Light& light, double diagonal, const glm::dmat4& matrix) {
        return count_bounce_places({0, 0, matrix}, light, diagonal, 4);
    };
    const glm::dmat4 one(1.0);
    EXPECT_EQ(count(area(3.0F, 4.0F), 12.4, one), 4);  // a diagonal of 5 m over four tenths of it
    EXPECT_EQ(count(area(3.0F, 4.0F), 12.6, one), 1);
    EXPECT_EQ(count(area(3.0F, 4.0F), 24.0, glm::scale(one, glm::dvec3(2.0))), 4);
    EXPECT_EQ(count(area(3.0F, 4.0F), 0.0, one), 1) << "a scene of one point";
    EXPECT_EQ(count(area(3.0F, 4.0F), std::numeric_limits<double>::infinity(), one), 1);
    scene::Light ball = area(3.0F, 4.0F);
    ball.type = scene::LightType::point;
    ball.radius_m = 5.0F;
    EXPECT_EQ(count(ball, 10.0, one), 1);
}

}  // namespace
}  // namespace bounce
