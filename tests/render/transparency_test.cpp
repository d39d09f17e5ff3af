// SPDX-License-Identifier: Apache-2.0
//
// Blended surfaces: layers from the camera on, the part of the light that passes them, and what they reflect.
#include <functional>

#include <gmock/gmock.h>

#include "render_fixture.h"

namespace bounce::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::Not;

// Alpha in a layer has 16 bits, emission is a float.
constexpr double k_exact = 2e-5;

class Transparency : public ::testing::Test {
  protected:
    void SetUp() override { require_context(); }
};

scene::Scene empty_scene() {
    scene::Scene scene;
    scene.from_blender = true;
    return scene;
}

int add_glow(scene::Scene& scene, const glm::vec3& emission, float alpha) {
    const int index = add_diffuse(scene, glm::vec3(0.0F));
    scene::Material& material = scene.materials.back();
    material.emission = emission;
    material.base_color.a = alpha;
    material.alpha_mode = scene::AlphaMode::blend;
    return index;
}

int add_veil(scene::Scene& scene, float alpha, const glm::vec3& color = glm::vec3(1.0F)) {
    const int index = add_diffuse(scene, color);
    scene.materials.back().base_color.a = alpha;
    scene.materials.back().alpha_mode = scene::AlphaMode::blend;
    return index;
}

void add_plane(scene::Scene& scene, float size, int material, double height, double x = 0.0) {
    add_mesh_node(scene, add_square(scene, size, material),
                  glm::translate(glm::dmat4(1.0), glm::dvec3(x, 0.0, height)));
}

Settings direct_settings(int pixels) {
    Settings s;
    s.width = s.height = pixels;
    s.technique = Technique::direct;
    return s;
}

void expect_color(const glm::dvec3& got, const glm::dvec3& want, double tolerance, const std::string& what) {
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(got[c], want[c], tolerance) << what << ", channel " << c;
    }
}

// Three panes over a floor, drawn in an order that is not theirs in depth.
scene::Scene stack() {
    scene::Scene scene = empty_scene();
    add_plane(scene, 4.0F, add_glow(scene, {0.2F, 0.2F, 0.2F}, 1.0F), 0.0);
    add_plane(scene, 4.0F, add_glow(scene, {0.0F, 1.0F, 0.0F}, 0.25F), 2.0);
    add_plane(scene, 4.0F, add_glow(scene, {1.0F, 0.0F, 0.0F}, 0.5F), 1.0);
    add_plane(scene, 4.0F, add_glow(scene, {0.0F, 0.0F, 4.0F}, 0.4F), 3.0);
    return scene;
}

TEST_F(Transparency, LayersAreBlendedFrontToBack) {
    const Rendered out = draw(stack(), camera_from_above(2.0, 10.0), direct_settings(16));
    const glm::dvec3 floor(0.2);
    const glm::dvec3 red = 0.5 * glm::dvec3(1.0, 0.0, 0.0) + 0.5 * floor;
    const glm::dvec3 green = 0.25 * glm::dvec3(0.0, 1.0, 0.0) + 0.75 * red;
    const glm::dvec3 blue = 0.4 * glm::dvec3(0.0, 0.0, 4.0) + 0.6 * green;
    expect_color(out.at(8, 8), blue, k_exact * 4.0, "three panes");
    EXPECT_THAT(out.report.executed, Contains("over, layer 3"));
    EXPECT_THAT(out.report.executed, Not(Contains("over, layer 4"))) << "its layer is empty";
    EXPECT_THAT(out.report.approximations, Each(Not(HasSubstr("left out"))));
}

TEST_F(Transparency, WhatLiesBeyondTheLastLayerIsLeftOutAndSaid) {
    Settings settings = direct_settings(16);
    settings.transparent_layers = 2;
    const Rendered out = draw(stack(), camera_from_above(2.0, 10.0), settings);
    const glm::dvec3 green = 0.25 * glm::dvec3(0.0, 1.0, 0.0) + 0.75 * glm::dvec3(0.2);
    expect_color(out.at(8, 8), 0.4 * glm::dvec3(0.0, 0.0, 4.0) + 0.6 * green, k_exact * 4.0, "two panes");
    EXPECT_THAT(out.report.approximations,
                Contains(AllOf(HasSubstr("256 pixels"), HasSubstr("--transparent-layers"))));
}

TEST_F(Transparency, WithoutLayersTheyAreCutOut) {
    Settings settings = direct_settings(16);
    settings.transparent_layers = 0;
    const Rendered out = draw(stack(), camera_from_above(2.0, 10.0), settings);
    expect_color(out.at(8, 8), {1.0, 0.0, 0.0}, k_exact, "the pane with alpha one half");
    EXPECT_THAT(out.report.approximations, Contains(HasSubstr("cut-out")));
}

TEST_F(Transparency, OpaqueAndAbsentOnesAreExact) {
    const auto with = [](float alpha, bool pane) {
        scene::Scene scene = empty_scene();
        add_plane(scene, 4.0F, add_diffuse(scene), 0.0);
        if (pane) {
            add_plane(scene, 1.0F, add_veil(scene, alpha, {0.7F, 0.2F, 0.1F}), 1.0);
        }
        scene::Light light;
        light.name = "light";
        light.type = scene::LightType::point;
        light.power_w = 100.0F;
        add_light(scene, light, glm::translate(glm::dmat4(1.0), glm::dvec3(0.7, 0.3, 2.5)));
        return scene;
    };
    const CameraView camera = camera_from_above(3.0, 10.0);
    scene::Scene opaque = with(1.0F, true);
    for (scene::Material& material : opaque.materials) {
        material.alpha_mode = scene::AlphaMode::opaque;
    }
    const Rendered solid = draw(opaque, camera, direct_settings(64));
    const Rendered one = draw(with(1.0F, true), camera, direct_settings(64));
    EXPECT_EQ(one.image.rgb, solid.image.rgb);
    EXPECT_EQ(one.report.executed, solid.report.executed);
    const auto unused = [](const FrameReport& report) {
        for (const LeftOut& entry : report.left_out) {
            if (entry.pass == "transparent layers") {
                return entry.reason;
            }
        }
        return std::string();
    };
    EXPECT_THAT(unused(one.report), HasSubstr("no visible surface is blended"));
    const Rendered none = draw(with(0.0F, true), camera, direct_settings(64));
    // The pane still counts for the scene's bounds, and so for the rounding of its coordinates.
    const Rendered without = draw(with(0.0F, false), camera, direct_settings(64));
    for (size_t i = 0; i < none.image.rgb.size(); ++i) {
        ASSERT_NEAR(none.image.rgb[i], without.image.rgb[i], 1e-5F * without.image.rgb[i]) << "at " << i;
    }
    EXPECT_EQ(none.report.executed, without.report.executed);
    EXPECT_NE(none.image.rgb, solid.image.rgb);
}

// Coverage times alpha at every pixel, those of outlines among them.
TEST_F(Transparency, OutlinesAreSmoothedAsThoseOfSolidSurfaces) {
    const auto turned = [](float alpha) {
        scene::Scene scene = empty_scene();
        add_mesh_node(scene, add_square(scene, 1.0F, add_glow(scene, glm::vec3(1.0F), alpha)),
                      glm::rotate(glm::dmat4(1.0), 0.4, glm::dvec3(0.0, 0.0, 1.0)));
        return scene;
    };
    const CameraView camera = camera_from_above(2.0, 10.0);
    const Rendered solid = draw(turned(1.0F), camera, direct_settings(48));
    const Rendered half = draw(turned(0.5F), camera, direct_settings(48));
    int between = 0;
    for (size_t i = 0; i < solid.image.rgb.size(); ++i) {
        ASSERT_NEAR(half.image.rgb[i], 0.5F * solid.image.rgb[i], k_exact) << "at " << i;
        between += solid.image.rgb[i] > 0.05F && solid.image.rgb[i] < 0.95F ? 1 : 0;
    }
    EXPECT_GT(between, 100) << "there are outlines to be smoothed";
}

struct Passed {
    double mean = 0.0;
    double deviation = 0.0;
};

// The part of the light that passes veils, over the middle of their shadow.
Passed passed(const std::vector<float>& alphas, scene::LightType type, Settings settings) {
    const auto make = [&](bool veils) {
        scene::Scene scene = empty_scene();
        add_plane(scene, 12.0F, add_diffuse(scene), 0.0);
        double height = 0.8;
        for (const float alpha : alphas) {
            if (veils) {
                // Beside the camera's view, in the light's way.
                add_plane(scene, 1.6F, add_veil(scene, alpha), height, -1.5 * height);
            }
            height += 0.17;
        }
        scene::Light light;
        light.name = "light";
        light.type = type;
        light.power_w = 500.0F;
        light.irradiance_w_m2 = 2.0F;
        const glm::dvec3 from = 3.0 * glm::dvec3(-1.5, 0.0, 1.0);
        glm::dmat4 place = glm::inverse(glm::lookAt(from, glm::dvec3(0.0), glm::dvec3(0.0, 1.0, 0.0)));
        add_light(scene, light, place);
        return scene;
    };
    settings.width = settings.height = 48;
    const CameraView camera = camera_from_above(0.5, 10.0);
    const Rendered shaded = draw(make(true), camera, settings);
    const Rendered lit = draw(make(false), camera, settings);
    Passed out;
    double squares = 0.0;
    for (int y = 0; y < 48; ++y) {
        for (int x = 0; x < 48; ++x) {
            const double part = shaded.at(x, y).x / lit.at(x, y).x;
            out.mean += part / (48.0 * 48.0);
            squares += part * part / (48.0 * 48.0);
        }
    }
    out.deviation = std::sqrt(std::max(squares - out.mean * out.mean, 0.0));
    return out;
}

// The mean of 64 maps, a part of which hold each veil: noise below a step of 1/64 for one, and for more what
// the sequence's dimensions are not independent by.
TEST_F(Transparency, APartOfTheLightPasses) {
    for (const scene::LightType type : {scene::LightType::sun, scene::LightType::point}) {
        const std::string what = type == scene::LightType::sun ? "sun" : "point";
        for (const float alpha : {0.1F, 0.5F, 0.8F}) {
            const Passed one = passed({alpha}, type, direct_settings(48));
            EXPECT_NEAR(one.mean, 1.0 - static_cast<double>(alpha), 0.004) << what << ", alpha " << alpha;
            EXPECT_LT(one.deviation, 1.0 / 64.0) << what << ", alpha " << alpha;
        }
        const Passed two = passed({0.5F, 0.4F}, type, direct_settings(48));
        EXPECT_NEAR(two.mean, 0.5 * 0.6, 0.025) << what << ", two veils let the product pass";
        EXPECT_LT(two.deviation, 0.015) << what;
        const Passed three = passed({0.5F, 0.5F, 0.5F}, type, direct_settings(48));
        EXPECT_NEAR(three.mean, 0.125, 0.025) << what << ", three";
    }
}

TEST_F(Transparency, HardShadowsAreThoseOfCutOuts) {
    Settings settings = direct_settings(48);
    settings.direct_shadows = DirectShadows::hard;
    EXPECT_NEAR(passed({0.4F}, scene::LightType::sun, settings).mean, 1.0, 1e-9);
    EXPECT_LT(passed({0.6F}, scene::LightType::sun, settings).mean, 1e-6);
}

// A wall of half a surface bounces half the light of a whole one onto the floor beside it.
TEST_F(Transparency, ReflectiveShadowMapsHoldAPartOfThem) {
    const auto bounced = [](float alpha) {
        scene::Scene scene = empty_scene();
        add_plane(scene, 3.0F, add_diffuse(scene), 0.0);
        add_mesh_node(scene, add_square(scene, 1.0F, add_veil(scene, alpha)),
                      glm::translate(glm::dmat4(1.0), glm::dvec3(-1.0, 0.0, 0.6)) *
                          glm::rotate(glm::dmat4(1.0), 0.5 * pi, glm::dvec3(0.0, 1.0, 0.0)));
        scene::Light light;
        light.name = "light";
        light.type = scene::LightType::spot;
        light.power_w = 100.0F;
        light.cone_angle_rad = 0.5F;
        // Along the wall's normal, so that nothing but the wall is lit.
        add_light(scene, light,
                  glm::inverse(glm::lookAt(glm::dvec3(1.0, 0.0, 0.6), glm::dvec3(-1.0, 0.0, 0.6),
                                           glm::dvec3(0.0, 0.0, 1.0))));
        Settings settings;
        settings.width = settings.height = 32;
        settings.technique = Technique::rsm;
        settings.show = Show::indirect;
        settings.rsm_full_sum = true;
        settings.rsm_size = 128;
        return draw(scene, camera_from_above(1.0, 10.0), settings).mean();
    };
    const double whole = bounced(1.0F);
    ASSERT_GT(whole, 0.0);
    EXPECT_NEAR(bounced(0.5F) / whole, 0.5, 0.01);
    EXPECT_NEAR(bounced(0.2F) / whole, 0.2, 0.01);
}

}  // namespace
}  // namespace bounce::test
