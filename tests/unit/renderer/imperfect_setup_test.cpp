// SPDX-License-Identifier: Apache-2.0
//
// What imperfect shadow maps of places on a light show. No OpenGL.
#include "renderer/imperfect_setup.h"

#include <bit>
#include <cmath>
#include <set>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace bounce {
namespace {

constexpr int k_places = 16;

const scene::Bounds k_bounds = [] {
    scene::Bounds bounds;
    bounds.grow({-2.0, -2.0, 0.0});
    bounds.grow({2.0, 2.0, 1.0});
    return bounds;
}();

struct Made {
    ImperfectSetup setup;
    IsmLayout layout;
};

scene::Light light_of(scene::LightType type) {
    scene::Light light;
    light.type = type;
    light.radius_m = 0.2F;
    light.angle_rad = 0.1F;
    light.size_x_m = light.size_y_m = 0.5F;
    light.cone_angle_rad = 2.0F;
    return light;
}

// Corners of a box, render space.
Region box(const glm::dvec3& low, const glm::dvec3& high) {
    Region out;
    for (int i = 0; i < 8; ++i) {
        out.emplace_back((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                         (i & 4) != 0 ? high.z : low.z);
    }
    return out;
}

Made make(const scene::Light& light, const glm::dmat4& at, const std::vector<Region>& receivers) {
    const gpu::RenderSpace space = gpu::RenderSpace::around(k_bounds);
    const LightSetup setup = set_up_light({0, 0, at}, light, k_bounds, space, 512, 2048);
    Settings settings;
    settings.direct_shadows = DirectShadows::ism;
    const IsmLayout layout =
        imperfect_layout(settings, k_places * imperfect_maps_a_place(setup, light, receivers), 100);
    return {set_up_imperfect_shadow(setup, light, receivers, k_places, layout), layout};
}

glm::dmat4 above(double height) {
    return glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, height));
}

// Where a map shows a place: within (-1, 1) both ways, if at all.
glm::dvec2 place_in_map(const gpu::GpuVpl& map, const glm::dvec3& p) {
    const glm::dvec3 d = glm::normalize(p - glm::dvec3(glm::vec3(map.position)));
    const glm::dvec3 in_map(glm::dot(d, glm::dvec3(glm::vec3(map.tangent))),
                            glm::dot(d, glm::dvec3(glm::vec3(map.bitangent))),
                            glm::dot(d, glm::dvec3(glm::vec3(map.normal))));
    EXPECT_GT(in_map.z, 0.0);
    const glm::dvec3 window(glm::vec3(map.incident));
    return (glm::dvec2(in_map) / (1.0 + in_map.z) - glm::dvec2(window)) / window.z;
}

TEST(ImperfectSetup, AMapHoldsAllReceiversAndLittleElse) {
    const Region seen = box({-0.1, 0.05, -0.2}, {0.2, 0.3, -0.18});
    for (const auto type : {scene::LightType::area, scene::LightType::point, scene::LightType::spot}) {
        const Made made = make(light_of(type), above(3.0), {seen});
        ASSERT_EQ(made.setup.maps.size(), static_cast<size_t>(k_places));
        EXPECT_FALSE(made.setup.both_sides || made.setup.distant);
        for (const gpu::GpuVpl& map : made.setup.maps) {
            double farthest = 0.0;
            // A box's surface: its corners are not all that the bent map must hold.
            for (int i = 0; i < 11 * 11 * 11; ++i) {
                const glm::dvec3 t = glm::dvec3(i % 11, i / 11 % 11, i / 121) / 10.0;
                const glm::dvec2 at = place_in_map(map, glm::mix(seen.front(), seen.back(), t));
                farthest = std::max({farthest, std::abs(at.x), std::abs(at.y)});
            }
            EXPECT_LT(farthest, 1.0) << static_cast<int>(type);
            EXPECT_GT(farthest, 0.85) << static_cast<int>(type);
        }
    }
}

TEST(ImperfectSetup, ALightAmongReceiversHasBothHemispheres) {
    const Region all_around = box({-0.4, -0.4, -0.4}, {0.4, 0.4, 0.4});
    const Made made = make(light_of(scene::LightType::point), above(0.5), {all_around});
    ASSERT_EQ(made.setup.maps.size(), 2U * k_places);
    EXPECT_TRUE(made.setup.both_sides);
    std::set<uint32_t> origins;
    for (int i = 0; i < k_places; ++i) {
        const gpu::GpuVpl& front = made.setup.maps[static_cast<size_t>(i)];
        const gpu::GpuVpl& back = made.setup.maps[static_cast<size_t>(i + k_places)];
        EXPECT_EQ(front.position, back.position);
        EXPECT_EQ(glm::vec3(front.normal), -glm::vec3(back.normal));
        const auto of_back = std::bit_cast<uint32_t>(back.bitangent.w);
        EXPECT_EQ(std::bit_cast<uint32_t>(front.incident.w), of_back)
            << "the front knows where the back's map is";
        origins.insert(std::bit_cast<uint32_t>(front.bitangent.w));
        origins.insert(of_back);
        EXPECT_EQ(glm::vec3(front.incident), glm::vec3(0.0F, 0.0F, 1.0F)) << "all of the hemisphere";
    }
    EXPECT_EQ(origins.size(), 2U * k_places) << "no two maps share a place in the atlas";
    // An area light has a dark back, and needs one.
    EXPECT_EQ(make(light_of(scene::LightType::area), above(0.5), {all_around}).setup.maps.size(),
              static_cast<size_t>(k_places));
}

TEST(ImperfectSetup, ASunsMapsHoldTheReceivers) {
    const Region seen = box({-0.1, -0.2, -0.2}, {0.2, 0.3, 0.1});
    const Made made = make(light_of(scene::LightType::sun), above(1.0), {seen});
    EXPECT_TRUE(made.setup.distant);
    ASSERT_EQ(made.setup.maps.size(), static_cast<size_t>(k_places));
    glm::dvec3 mean(0.0);
    for (const gpu::GpuVpl& map : made.setup.maps) {
        mean += glm::dvec3(glm::vec3(map.normal)) / static_cast<double>(k_places);
        for (const glm::dvec3& p : seen) {
            const glm::dvec3 d = p - glm::dvec3(glm::vec3(map.position));
            for (const glm::vec4& axis : {map.tangent, map.bitangent, map.normal}) {
                EXPECT_LT(std::abs(glm::dot(d, glm::dvec3(glm::vec3(axis)))),
                          static_cast<double>(map.tangent.w));
            }
        }
    }
    EXPECT_NEAR(glm::length(mean - glm::dvec3(0.0, 0.0, -1.0)), 0.0, 0.01) << "around the sun's way";
}

TEST(ImperfectSetup, NothingSeenIsNoError) {
    for (const auto type : {scene::LightType::area, scene::LightType::point, scene::LightType::sun}) {
        for (const gpu::GpuVpl& map : make(light_of(type), above(3.0), {}).setup.maps) {
            EXPECT_TRUE(std::isfinite(map.position.x + map.incident.x + map.incident.z + map.tangent.w));
        }
    }
}

}  // namespace
}  // namespace bounce
