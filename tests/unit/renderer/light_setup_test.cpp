// SPDX-License-Identifier: Apache-2.0
//
// Lights as the shaders get them: axes, maps, cones, power.
#include "renderer/light_setup.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace bounce {
namespace {

constexpr double pi = std::numbers::pi;

scene::Bounds box(const glm::dvec3& low, const glm::dvec3& high) {
    scene::Bounds bounds;
    bounds.grow(low);
    bounds.grow(high);
    return bounds;
}

scene::Light light_of(scene::LightType type) {
    scene::Light light;
    light.type = type;
    light.power_w = 12.0F;
    light.irradiance_w_m2 = 3.0F;
    light.cone_angle_rad = 1.0F;
    light.size_x_m = 1.0F;
    light.size_y_m = 2.0F;
    return light;
}

LightSetup set_up(const scene::Light& light, const glm::dmat4& matrix = glm::dmat4(1.0),
                  const scene::Bounds& bounds = box({-1, -1, -1}, {1, 1, 1}),
                  const gpu::RenderSpace& space = {}) {
    return set_up_light({0, 0, matrix}, light, bounds, space, 512, 2048);
}

void expect_orthonormal(const gpu::GpuLight& gpu) {
    const glm::vec3 t(gpu.tangent);
    const glm::vec3 b(gpu.bitangent);
    const glm::vec3 a(gpu.axis);
    for (const glm::vec3& v : {t, b, a}) {
        EXPECT_NEAR(glm::length(v), 1.0F, 1e-6F);
    }
    EXPECT_NEAR(glm::dot(t, b), 0.0F, 1e-6F);
    EXPECT_NEAR(glm::dot(t, a), 0.0F, 1e-6F);
    EXPECT_NEAR(glm::dot(b, a), 0.0F, 1e-6F);
    // One handedness, whatever the node's: the maps' front faces depend on it.
    EXPECT_NEAR(glm::dot(glm::cross(t, a), b), 1.0F, 1e-6F);
}

TEST(LightSetup, AxesAreOrthonormalForAnyTransform) {
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), 0.8, glm::normalize(glm::dvec3(1, 2, 3)));
    glm::dmat4 sheared = turned;
    sheared[0] += 0.7 * sheared[2];
    const std::vector<std::pair<std::string, glm::dmat4>> matrices = {
        {"identity", glm::dmat4(1.0)},
        {"turned", turned},
        {"mirrored", glm::scale(turned, glm::dvec3(-1, 1, 1))},
        {"mirrored along its axis", glm::scale(turned, glm::dvec3(1, 1, -1))},
        {"not uniform", glm::scale(turned, glm::dvec3(1e-3, 5, 1e4))},
        {"sheared", sheared},
        {"no X", glm::scale(turned, glm::dvec3(0, 1, 1))},
        {"no Z", glm::scale(turned, glm::dvec3(1, 1, 0))},
        {"X along Z", glm::dmat4({0, 0, 1, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1})},
        {"nothing", glm::scale(glm::dmat4(1.0), glm::dvec3(0.0))},
        {"tiny", glm::scale(turned, glm::dvec3(1e-200))},
        {"looking along X without X", glm::dmat4({0, 0, 0, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}, {0, 0, 0, 1})}};
    for (const auto& [name, matrix] : matrices) {
        for (const auto type : {scene::LightType::point, scene::LightType::spot, scene::LightType::sun,
                                scene::LightType::area}) {
            SCOPED_TRACE(name + ", light type " + std::to_string(static_cast<int>(type)));
            const LightSetup setup = set_up(light_of(type), matrix);
            expect_orthonormal(setup.gpu);
            for (const LightFace& face : setup.faces) {
                for (int column = 0; column < 4; ++column) {
                    for (int row = 0; row < 4; ++row) {
                        EXPECT_TRUE(std::isfinite(face.clip_from_render[column][row]));
                    }
                }
            }
        }
    }
}

TEST(LightSetup, LooksAlongMinusZOfItsNode) {
    const glm::dmat4 matrix =
        glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(3, 4, 5)), pi / 2, glm::dvec3(1, 0, 0));
    const LightSetup setup = set_up(light_of(scene::LightType::spot), matrix);
    EXPECT_LT(glm::length(glm::vec3(setup.gpu.axis) - glm::vec3(0, 1, 0)), 1e-6F);
    EXPECT_LT(glm::length(glm::vec3(setup.gpu.position) - glm::vec3(3, 4, 5)), 1e-6F);
}

TEST(LightSetup, SunMapHoldsTheWholeScene) {
    const scene::Bounds bounds = box({-3, 0, -20}, {5, 1, 4});
    const gpu::RenderSpace space = gpu::RenderSpace::around(bounds);
    for (int step = 0; step < 40; ++step) {
        const glm::dmat4 matrix =
            glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(1e4, -7, 2)), 0.37 * step,
                        glm::normalize(glm::dvec3(std::sin(step), std::cos(1.7 * step), 0.3)));
        const LightSetup setup = set_up(light_of(scene::LightType::sun), matrix, bounds, space);
        ASSERT_EQ(setup.faces.size(), 1U);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 world((corner & 1) != 0 ? 5 : -3, (corner & 2) != 0 ? 1 : 0,
                                   (corner & 4) != 0 ? 4 : -20);
            const glm::vec4 p =
                setup.faces[0].clip_from_render * glm::vec4(glm::vec3(space.point(world)), 1.0F);
            EXPECT_LE(std::abs(p.x), 1.0F);
            EXPECT_LE(std::abs(p.y), 1.0F);
            EXPECT_GE(p.z, 0.0F);
            EXPECT_LE(p.z, 1.0F);
            EXPECT_EQ(p.w, 1.0F);
        }
    }
}

TEST(LightSetup, SunMapIsNoLargerThanItNeedsToBe) {
    // Straight down on a box 8 x 24 m and 1 m high: half a percent of room on each side.
    const glm::dmat4 down = glm::rotate(glm::dmat4(1.0), -pi / 2, glm::dvec3(1, 0, 0));
    const LightSetup setup = set_up(light_of(scene::LightType::sun), down, box({-3, 0, -20}, {5, 1, 4}));
    EXPECT_NEAR(setup.gpu.tangent.w, 4.0 * 1.01, 1e-5);
    EXPECT_NEAR(setup.gpu.bitangent.w, 12.0 * 1.01, 1e-5);
    EXPECT_NEAR(setup.gpu.map.z, 1.01, 1e-5);
    EXPECT_NEAR(setup.flux_w, 3.0 * 8.0 * 24.0 * 1.01 * 1.01, 1e-2)
        << "irradiance times the map's cross-section";
}

TEST(LightSetup, SunKeepsAVolumeOverAFlatOrEmptyScene) {
    for (const scene::Bounds& bounds : {box({0, 0, 0}, {2, 0, 2}), box({1, 1, 1}, {1, 1, 1})}) {
        const LightSetup setup = set_up(light_of(scene::LightType::sun), glm::dmat4(1.0), bounds);
        EXPECT_GT(setup.gpu.tangent.w, 0.0F);
        EXPECT_GT(setup.gpu.bitangent.w, 0.0F);
        EXPECT_GT(setup.gpu.map.z, 0.0F);
    }
    const LightSetup nothing = set_up(light_of(scene::LightType::sun), glm::dmat4(1.0), scene::Bounds{});
    EXPECT_TRUE(std::isfinite(nothing.gpu.tangent.w));
    EXPECT_TRUE(std::isfinite(nothing.gpu.map.z));
    EXPECT_TRUE(std::isfinite(nothing.flux_w));
    EXPECT_TRUE(std::isfinite(nothing.faces[0].clip_from_render[0][0]));
}

TEST(LightSetup, MapKindFollowsTheLightAndItsCone) {
    EXPECT_EQ(set_up(light_of(scene::LightType::point)).map_kind, MAP_CUBE);
    EXPECT_EQ(set_up(light_of(scene::LightType::area)).map_kind, MAP_CUBE);
    EXPECT_EQ(set_up(light_of(scene::LightType::sun)).map_kind, MAP_ORTHOGRAPHIC);
    scene::Light spot = light_of(scene::LightType::spot);
    const auto kind_at = [&](double degrees) {
        spot.cone_angle_rad = static_cast<float>(degrees * pi / 180.0);
        return set_up(spot).map_kind;
    };
    EXPECT_EQ(kind_at(1.0), MAP_PERSPECTIVE);
    EXPECT_EQ(kind_at(119.9), MAP_PERSPECTIVE);
    EXPECT_EQ(kind_at(120.1), MAP_CUBE);
    EXPECT_EQ(kind_at(180.0), MAP_CUBE);
}

TEST(LightSetup, PlanarMapsHaveOneFaceAndCubesSixOfHalfTheSize) {
    const LightSetup spot = set_up(light_of(scene::LightType::spot));
    EXPECT_EQ(spot.faces.size(), 1U);
    EXPECT_EQ(spot.gpu.map.x, 512.0F);
    EXPECT_EQ(spot.gpu.map.y, 2048.0F);
    const LightSetup point = set_up(light_of(scene::LightType::point));
    EXPECT_EQ(point.faces.size(), 6U);
    EXPECT_EQ(point.gpu.map.x, 256.0F);
    EXPECT_EQ(point.gpu.map.y, 1024.0F);
    const LightSetup smallest =
        set_up_light({0, 0, glm::dmat4(1.0)}, light_of(scene::LightType::point), {}, {}, 1, 1);
    EXPECT_EQ(smallest.gpu.map.x, 1.0F);
    EXPECT_EQ(smallest.gpu.map.y, 1.0F);
}

TEST(LightSetup, FacesSayWhetherTheyMirror) {
    // A front face seen in the map turns over exactly where its projection's first three rows are
    // left-handed.
    for (const auto type : {scene::LightType::point, scene::LightType::spot, scene::LightType::sun}) {
        const LightSetup setup =
            set_up(light_of(type), glm::rotate(glm::dmat4(1.0), 0.5, glm::dvec3(1, 0, 0)));
        for (const LightFace& face : setup.faces) {
            const glm::dmat4 m(face.clip_from_render);
            const glm::dvec3 x(m[0][0], m[1][0], m[2][0]);
            const glm::dvec3 y(m[0][1], m[1][1], m[2][1]);
            // Where the map looks: along w (perspective), against z (orthographic).
            const glm::dvec3 forward = setup.map_kind == MAP_ORTHOGRAPHIC
                                           ? -glm::dvec3(m[0][2], m[1][2], m[2][2])
                                           : glm::dvec3(m[0][3], m[1][3], m[2][3]);
            // X right and Y up of a picture that is seen as by an eye: x cross y points back at it.
            const bool mirrored = glm::dot(glm::cross(x, y), forward) > 0.0;
            EXPECT_EQ(face.mirrored, mirrored) << "light type " << static_cast<int>(type);
        }
    }
}

TEST(LightSetup, SpotMapTouchesTheCone) {
    scene::Light spot = light_of(scene::LightType::spot);
    spot.cone_angle_rad = 1.2F;
    const LightSetup setup = set_up(spot);
    const double t = std::tan(0.6);
    EXPECT_NEAR(setup.gpu.axis.w, t, 1e-6);
    const glm::vec4 p =
        setup.faces[0].clip_from_render * glm::vec4(static_cast<float>(5.0 * t), 0.0F, -5.0F, 1.0F);
    EXPECT_NEAR(std::abs(p.x / p.w), 1.0, 1e-6);
}

TEST(LightSetup, ConeValuesOfBlendersSpot) {
    scene::Light spot = light_of(scene::LightType::spot);
    spot.blend = 0.25F;
    const LightSetup soft = set_up(spot);
    EXPECT_EQ(soft.profile, PROFILE_SPOT_CYCLES_3);
    EXPECT_NEAR(soft.gpu.cone.x, 1.0 - std::cos(0.5), 1e-6);
    EXPECT_NEAR(soft.gpu.cone.y, 1.0 / ((1.0 - std::cos(0.5)) * 0.25), 1e-4);
    spot.blend = 0.0F;
    EXPECT_EQ(set_up(spot).gpu.cone.y, 0.0F) << "a hard edge";
    spot.profile = scene::SpotProfile::cycles_4;
    EXPECT_EQ(set_up(spot).profile, PROFILE_SPOT_CYCLES_4);
}

TEST(LightSetup, ConeValuesOfKhronosSpot) {
    scene::Light spot = light_of(scene::LightType::spot);
    spot.profile = scene::SpotProfile::khronos;
    spot.inner_cone_rad = 0.2F;
    const gpu::GpuLight gpu = set_up(spot).gpu;
    // 1 at the inner cone, 0 at the outer one.
    EXPECT_NEAR(std::cos(0.2) * static_cast<double>(gpu.cone.x) + static_cast<double>(gpu.cone.y), 1.0, 1e-4);
    EXPECT_NEAR(std::cos(0.5) * static_cast<double>(gpu.cone.x) + static_cast<double>(gpu.cone.y), 0.0, 1e-4);
    spot.inner_cone_rad = 0.5F;  // as wide as the outer one: a hard edge, not a division by zero
    EXPECT_TRUE(std::isfinite(set_up(spot).gpu.cone.x));
}

TEST(LightSetup, IntensityAndFluxAreThoseOfTheLaws) {
    scene::Light point = light_of(scene::LightType::point);
    point.color = {1.0F, 0.5F, 0.0F};
    point.radius_m = 0.5F;
    const gpu::RenderSpace space{{0, 0, 0}, 0.1};
    const LightSetup p = set_up(point, glm::dmat4(1.0), box({-5, -5, -5}, {5, 5, 5}), space);
    // P/(4 pi), times scale^2 because distances shrink with it.
    EXPECT_NEAR(p.gpu.intensity.x, 12.0 / (4.0 * pi) * 0.01, 1e-8);
    EXPECT_NEAR(p.gpu.intensity.y, 0.5 * 12.0 / (4.0 * pi) * 0.01, 1e-8);
    EXPECT_NEAR(p.gpu.intensity.w, 0.05 * 0.05, 1e-8) << "the squared radius";
    EXPECT_NEAR(p.flux_w, 12.0 * (0.2126 + 0.5 * 0.7152), 1e-5);

    const LightSetup spot = set_up(light_of(scene::LightType::spot));
    EXPECT_NEAR(spot.gpu.intensity.x, 12.0 / (4.0 * pi), 1e-6) << "the cone does not concentrate power";
    EXPECT_NEAR(spot.flux_w, 12.0 * 0.5 * (1.0 - std::cos(0.5)), 1e-5);

    const LightSetup area =
        set_up(light_of(scene::LightType::area), glm::scale(glm::dmat4(1.0), glm::dvec3(3, 1, 1)));
    EXPECT_NEAR(area.gpu.intensity.x, 12.0 / 4.0, 1e-6) << "radiance P/(4A) times A";
    EXPECT_NEAR(area.gpu.area.x, 1.5, 1e-6) << "half sizes, after the node's scale";
    EXPECT_NEAR(area.gpu.area.y, 1.0, 1e-6);
    EXPECT_NEAR(set_up(light_of(scene::LightType::sun)).gpu.intensity.x, 3.0, 1e-6);
}

}  // namespace
}  // namespace bounce
