// SPDX-License-Identifier: Apache-2.0
//
// What the camera sees, and the maps of a light with a size that are fitted to it. No OpenGL.
#include "renderer/soft_setup.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "renderer/penumbra.h"

namespace bounce {
namespace {

constexpr double pi = std::numbers::pi;

const scene::Bounds k_bounds = [] {
    scene::Bounds bounds;
    bounds.grow({-2.0, -2.0, 0.0});
    bounds.grow({2.0, 2.0, 1.0});
    return bounds;
}();

// A box as wide as the frame of a camera at the origin that looks along -Z with clip = (x, y, near, -z).
glm::dmat4 plain_camera() {
    glm::dmat4 m(0.0);
    m[0][0] = m[1][1] = 1.0;
    m[3][2] = 0.1;
    m[2][3] = -1.0;
    return m;
}

TEST(SeenRegions, AreThePartsOfBoxesInThePicture) {
    const glm::dmat4 clip = plain_camera();
    const gpu::DrawBox half_seen{{0.0F, -1.0F, -4.0F}, {8.0F, 1.0F, -2.0F}};
    const gpu::DrawBox behind{{-1.0F, -1.0F, 1.0F}, {1.0F, 1.0F, 2.0F}};
    const gpu::DrawBox around{{-1.0F, -1.0F, -1.0F}, {1.0F, 1.0F, 1.0F}};
    const std::vector<Region> seen =
        seen_regions({half_seen, behind, around}, half_seen, clip, glm::inverse(clip));
    ASSERT_EQ(seen.size(), 2U) << "what is behind the camera is not seen";
    double widest = 0.0;
    for (const glm::dvec3& p : seen[0]) {
        EXPECT_LE(std::abs(p.x), -p.z + 1e-9);
        widest = std::max(widest, p.x);
    }
    EXPECT_NEAR(widest, 4.0, 1e-9) << "at the far side of the box";
    // The camera stands in this box: what is seen begins at the near plane.
    double nearest = -10.0;
    for (const glm::dvec3& p : seen[1]) {
        nearest = std::max(nearest, p.z);
    }
    EXPECT_NEAR(nearest, -0.1, 1e-9);
}

TEST(SeenRegions, AnUnknownBoxIsTheWholeScene) {
    const glm::dmat4 clip = plain_camera();
    const gpu::DrawBox all{{-1.0F, -1.0F, -3.0F}, {1.0F, 1.0F, -2.0F}};
    const std::vector<Region> seen = seen_regions({gpu::DrawBox{}}, all, clip, glm::inverse(clip));
    ASSERT_EQ(seen.size(), 1U);
    EXPECT_FALSE(seen[0].empty());
}

TEST(Clipped, KeepsTheSideOfThePlaneAndItsCut) {
    const Region edge = {{0.0, 0.0, -1.0}, {0.0, 0.0, 3.0}};
    const Region above = clipped(edge, {0.0, 0.0, 1.0, 0.0});
    ASSERT_EQ(above.size(), 2U);
    EXPECT_NEAR(std::min(above[0].z, above[1].z), 0.0, 1e-12);
    EXPECT_TRUE(clipped(edge, {0.0, 0.0, 1.0, -4.0}).empty());
}

struct Case {
    scene::Light light;
    glm::dmat4 place{1.0};
};

SoftSetup set_up(const Case& c, const std::vector<Region>& receivers) {
    const gpu::RenderSpace space = gpu::RenderSpace::around(k_bounds);
    const LightSetup setup = set_up_light({0, 0, c.place}, c.light, k_bounds, space, 512, 2048);
    return set_up_soft_shadow(setup, c.light, receivers, gpu::draw_box(k_bounds, space), 16, 512);
}

scene::Light light_of(scene::LightType type) {
    scene::Light light;
    light.type = type;
    light.power_w = 1.0F;
    light.radius_m = 0.3F;
    light.angle_rad = 0.2F;
    light.size_x_m = light.size_y_m = 0.6F;
    light.cone_angle_rad = 1.2F;
    return light;
}

// A floor of a metre in the middle of the scene, render space.
std::vector<Region> floor_region() {
    const gpu::RenderSpace space = gpu::RenderSpace::around(k_bounds);
    Region region;
    for (const double x : {-0.5, 0.5}) {
        for (const double y : {-0.5, 0.5}) {
            region.push_back(space.point({x, y, 0.0}));
        }
    }
    return {region};
}

// A place of the receivers lies in the map at the same place by the matrix that draws it and by the rows that
// shaders look it up with, within the map, and the map's ray goes back through it.
TEST(SoftSetup, DrawsAndLooksUpTheSamePlace) {
    const std::vector<Region> floor = floor_region();
    for (const auto type :
         {scene::LightType::point, scene::LightType::spot, scene::LightType::sun, scene::LightType::area}) {
        const glm::dmat4 place = glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(0.4, 0.2, 3.0)), 0.1,
                                             glm::dvec3(0.0, 1.0, 0.0));
        const SoftSetup setup = set_up({light_of(type), place}, floor_region());
        ASSERT_NE(setup.map_kind, MAP_CUBE) << static_cast<int>(type);
        ASSERT_EQ(setup.views.size(), 16U);
        ASSERT_EQ(setup.faces.size(), 16U);
        EXPECT_EQ(setup.layers, 16);
        for (size_t i = 0; i < setup.views.size(); ++i) {
            const gpu::GpuShadowView& view = setup.views[i];
            for (const glm::dvec3& p : floor[0]) {
                const glm::dvec4 clip = glm::dmat4(setup.faces[i].view.clip_from_render) * glm::dvec4(p, 1.0);
                const glm::dvec3 d = p - glm::dvec3(glm::vec3(view.origin));
                const double depth = glm::dot(glm::dvec3(glm::vec3(view.to_depth)), d);
                const bool sun = type == scene::LightType::sun;
                const double per = sun ? 1.0 : depth;
                const double s = glm::dot(glm::dvec3(glm::vec3(view.to_s)), d) / per;
                const double t = glm::dot(glm::dvec3(glm::vec3(view.to_t)), d) / per;
                EXPECT_NEAR(clip.x / clip.w, s, 1e-4);
                EXPECT_NEAR(clip.y / clip.w, t, 1e-4);
                EXPECT_LT(std::max(std::abs(s), std::abs(t)), 1.0) << "within the map";
                EXPECT_GT(std::max(std::abs(s), std::abs(t)), 0.5) << "which is fitted to it";
                const glm::dvec3 across =
                    s * glm::dvec3(glm::vec3(view.right)) + t * glm::dvec3(glm::vec3(view.up));
                const glm::dvec3 forward(glm::vec3(view.forward));
                const glm::dvec3 back = sun ? across + depth * forward : depth * (across + forward);
                EXPECT_NEAR(glm::length(back - d), 0.0, 1e-5);
                EXPECT_GT(clip.z / clip.w, 0.0);
                EXPECT_LT(clip.z / clip.w, 1.0);
            }
        }
    }
}

TEST(SoftSetup, PlacesSpanTheLight) {
    const gpu::RenderSpace space = gpu::RenderSpace::around(k_bounds);
    const glm::dmat4 place = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, 3.0));
    const glm::dvec3 middle = space.point({0.0, 0.0, 3.0});
    for (const auto type : {scene::LightType::point, scene::LightType::area}) {
        const SoftSetup setup = set_up({light_of(type), place}, floor_region());
        double reach = 0.0;
        glm::dvec3 mean(0.0);
        for (const gpu::GpuShadowView& view : setup.views) {
            const glm::dvec3 d = glm::dvec3(glm::vec3(view.origin)) - middle;
            reach = std::max(reach, std::abs(d.x) / space.scale);
            mean += d / 16.0 / space.scale;
            EXPECT_LE(std::abs(d.x) / space.scale, 0.3001);
            if (type == scene::LightType::area) {
                EXPECT_NEAR(d.z, 0.0, 1e-6);
            }
        }
        EXPECT_GT(reach, 0.2);
        EXPECT_LT(glm::length(mean), 0.06);
    }
}

TEST(SoftSetup, ANarrowSpreadLooksAlongItsDirectionsFromTheLightsPlane) {
    // At 3 m two degrees of spread show 5 cm of a light of 60 cm, in which few of 16 places would lie.
    const gpu::RenderSpace space = gpu::RenderSpace::around(k_bounds);
    const glm::dmat4 place = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, 3.0));
    const double plane = space.point({0.0, 0.0, 3.0}).z;
    scene::Light light = light_of(scene::LightType::area);
    light.spread_rad = static_cast<float>(2.0 * pi / 180.0);
    const SoftSetup setup = set_up({light, place}, floor_region());
    ASSERT_EQ(setup.map_kind, MAP_ORTHOGRAPHIC);
    ASSERT_EQ(setup.views.size(), 16U);
    EXPECT_TRUE(setup.begins_near);
    double widest = 0.0;
    for (const gpu::GpuShadowView& view : setup.views) {
        const glm::dvec3 forward(glm::vec3(view.forward));
        const double slant = std::hypot(forward.x, forward.y) / -forward.z;
        EXPECT_LE(slant, std::tan(pi / 180.0) * 1.0001);
        widest = std::max(widest, slant);
        EXPECT_NEAR(view.origin.z, plane, 1e-6) << "what is behind the light hides nothing";
    }
    EXPECT_GT(widest, 0.7 * std::tan(pi / 180.0));
    // A wide one, or an image over the light, is told by places on it.
    light.spread_rad = static_cast<float>(0.4 * pi);
    EXPECT_EQ(set_up({light, place}, floor_region()).map_kind, MAP_PERSPECTIVE);
    light.spread_rad = static_cast<float>(2.0 * pi / 180.0);
    light.pattern = {1, 1, {glm::vec3(1.0F)}};
    EXPECT_EQ(set_up({light, place}, floor_region()).map_kind, MAP_PERSPECTIVE);
}

TEST(SoftSetup, ALightAmongItsReceiversTakesTheFacesThatSeeThem) {
    const gpu::RenderSpace space = gpu::RenderSpace::around(k_bounds);
    std::vector<Region> receivers = floor_region();
    receivers.push_back({space.point({0.2, 0.1, 0.9}), space.point({-0.2, -0.3, 0.9})});  // above the light
    const glm::dmat4 place = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, 0.5));
    const SoftSetup point = set_up({light_of(scene::LightType::point), place}, receivers);
    EXPECT_EQ(point.map_kind, MAP_CUBE);
    EXPECT_EQ(point.size, 256);
    EXPECT_EQ(point.layers, 96);
    EXPECT_LE(point.faces.size(), 96U);
    // An area light looks down: what is above it it does not light, and a picture of the floor will do.
    const SoftSetup area = set_up({light_of(scene::LightType::area), place}, receivers);
    EXPECT_NE(area.map_kind, MAP_CUBE);
}

TEST(Penumbra, OfASunIsItsAngleOverTheSceneAndOfALampNoWiderThanSimilarTriangles) {
    const double diagonal = k_bounds.diagonal();
    const scene::LightInstance far{0, 0, glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, 101.0))};
    EXPECT_NEAR(widest_penumbra_m(far, light_of(scene::LightType::sun), k_bounds),
                2.0 * std::tan(0.1) * diagonal, 1e-6);
    EXPECT_NEAR(widest_penumbra_m(far, light_of(scene::LightType::point), k_bounds),
                0.6 * diagonal / (100.0 - 0.3), 1e-6);
    const scene::LightInstance among{0, 0, glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, 0.5))};
    EXPECT_TRUE(std::isinf(widest_penumbra_m(among, light_of(scene::LightType::point), k_bounds)));
    scene::Light sizeless = light_of(scene::LightType::spot);
    sizeless.radius_m = 0.0F;
    EXPECT_EQ(widest_penumbra_m(among, sizeless, k_bounds), 0.0);
}

TEST(Penumbra, ThePixelIsThatOfTheNearestPlace) {
    CameraView view;
    view.world_from_camera = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, 11.0));
    view.camera.yfov_rad = 2.0F * std::atan(0.5F);
    const gpu::RenderSpace space = gpu::RenderSpace::around(k_bounds);
    // Ten metres to the top of the bounds; a picture there is ten metres high.
    EXPECT_NEAR(finest_pixel_m(view, camera_matrices(view, 200, 100, space), space, k_bounds), 0.1, 1e-5);
    view.camera.perspective = false;
    view.camera.ymag = 5.0F;
    EXPECT_NEAR(finest_pixel_m(view, camera_matrices(view, 200, 100, space), space, k_bounds), 0.1, 1e-5);
}

}  // namespace
}  // namespace bounce
