// SPDX-License-Identifier: Apache-2.0
//
// What a frame runs, scene by scene: passes that a scene does not need are not there.
#include <algorithm>

#include "ism_fixture.h"

namespace bounce::test {
namespace {

class ExecutedPasses : public ::testing::Test {
  protected:
    void SetUp() override { require_context(); }

    static std::vector<std::string> run(const scene::Scene& scene, Settings settings) {
        settings.width = 32;
        settings.height = 32;
        settings.antialias = false;  // tests/render/antialias_test.cpp has its passes
        return draw(scene, camera_from_above(4.0, 10.0), settings).report.executed;
    }
    static scene::Scene floor() {
        scene::Scene scene;
        scene.from_blender = true;
        add_mesh_node(scene, add_square(scene, 4.0F, add_diffuse(scene)), glm::dmat4(1.0));
        return scene;
    }
    static scene::Light spot() {
        scene::Light light;
        light.name = "Spot";
        light.type = scene::LightType::spot;
        light.power_w = 10.0F;
        light.cone_angle_rad = 1.0F;
        return light;
    }
    using Passes = std::vector<std::string>;
};

TEST_F(ExecutedPasses, EmptySceneDrawsNothingButThePicture) {
    EXPECT_EQ(run({}, {}), (Passes{"gbuffer", "composite"}));
}

TEST_F(ExecutedPasses, SpotWithInterpolatedRsm) {
    scene::Scene scene = floor();
    add_light(scene, spot(), glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, 2.0)));
    Settings settings;
    settings.technique = Technique::rsm;
    EXPECT_EQ(run(scene, settings),
              (Passes{"gbuffer", "shadow map: Spot", "direct light: Spot", "rsm: Spot",
                      "rsm gather, low resolution", "rsm interpolate", "rsm gather, rest", "composite"}));
}

TEST_F(ExecutedPasses, DirectOnlyHasNoRsm) {
    scene::Scene scene = floor();
    add_light(scene, spot(), glm::dmat4(1.0));
    Settings settings;
    settings.technique = Technique::direct;
    EXPECT_EQ(run(scene, settings),
              (Passes{"gbuffer", "shadow map: Spot", "direct light: Spot", "composite"}));
}

TEST_F(ExecutedPasses, IndirectOnlyHasNoShadowMap) {
    scene::Scene scene = floor();
    add_light(scene, spot(), glm::dmat4(1.0));
    Settings settings;
    settings.technique = Technique::rsm;
    settings.show = Show::indirect;
    settings.interpolate = false;
    EXPECT_EQ(run(scene, settings), (Passes{"gbuffer", "rsm: Spot", "rsm gather", "composite"}));
}

TEST_F(ExecutedPasses, DarkLightAndShadowlessLight) {
    scene::Scene scene = floor();
    scene::Light dark = spot();
    dark.power_w = 0.0F;
    scene::Light shadowless = spot();
    shadowless.name = "Fill";
    shadowless.cast_shadow = false;
    add_light(scene, dark, glm::dmat4(1.0));
    add_light(scene, shadowless, glm::dmat4(1.0));
    Settings settings;
    settings.technique = Technique::direct;
    EXPECT_EQ(run(scene, settings), (Passes{"gbuffer", "direct light: Fill", "composite"}));
}

TEST_F(ExecutedPasses, LayerViewDropsWhatItDoesNotShow) {
    scene::Scene scene = floor();
    add_light(scene, spot(), glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, 2.0)));
    Settings settings;
    settings.show = Show::rsm_flux;
    EXPECT_EQ(run(scene, settings), (Passes{"rsm: Spot", "rsm layer view"})) << "the G-buffer is culled";
}

TEST_F(ExecutedPasses, BlackSurfacesBounceNothing) {
    scene::Scene scene;
    scene.from_blender = true;
    add_mesh_node(scene, add_square(scene, 4.0F, add_diffuse(scene, glm::vec3(0.0F))), glm::dmat4(1.0));
    add_light(scene, spot(), glm::dmat4(1.0));
    EXPECT_EQ(run(scene, {}), (Passes{"gbuffer", "shadow map: Spot", "direct light: Spot", "composite"}));
}

// A floor, a wall and something that stands between them.
scene::Scene occluded_scene() {
    scene::Scene scene = corner_scene();
    add_wall_spot(scene);
    scene.lights[0].name = "Spot";
    add_mesh_node(scene, add_ball(scene, add_diffuse(scene), 0.25F), moved({-1.0, 0.0, 0.75}));
    return scene;
}

TEST_F(ExecutedPasses, ImperfectShadowMaps) {
    EXPECT_EQ(run(occluded_scene(), {}),
              (Passes{"gbuffer", "shadow map: Spot", "direct light: Spot", "rsm: Spot", "points",
                      "vpl importance", "vpls", "ism disks", "vpl gather", "near tiles", "near field",
                      "blur, horizontal", "blur, vertical", "composite"}));
}

TEST_F(ExecutedPasses, OpenScenesHaveNoShadowMapsOfVpls) {
    // All is on the hull: nothing stands between.
    scene::Scene scene = corner_scene();
    add_wall_spot(scene);
    scene.lights[0].name = "Spot";
    Settings settings;
    settings.show = Show::indirect;
    const Passes open = run(scene, settings);
    EXPECT_EQ(open, (Passes{"gbuffer", "rsm: Spot", "vpl importance", "vpls", "vpl gather", "near tiles",
                            "near field", "blur, horizontal", "blur, vertical", "composite"}));
    settings.visibility = Visibility::none;
    EXPECT_EQ(run(occluded_scene(), settings), open) << "as without visibility";
}

TEST_F(ExecutedPasses, WhatIsSwitchedOffIsNotThere) {
    Settings settings;
    settings.show = Show::indirect;
    settings.interleave = 1;
    settings.near_field = false;
    EXPECT_EQ(run(occluded_scene(), settings), (Passes{"gbuffer", "rsm: Spot", "points", "vpl importance",
                                                       "vpls", "ism disks", "vpl gather", "composite"}));
}

TEST_F(ExecutedPasses, SplatsOfEachKind) {
    Settings settings;
    settings.show = Show::indirect;
    settings.interleave = 1;
    settings.near_field = false;
    const auto with = [&](Splat splat, int size, PullPush pull_push) {
        settings.splat = splat;
        settings.ism_size = size;
        settings.pull_push = pull_push;
        Passes passes = run(occluded_scene(), settings);
        passes.erase(std::remove_if(passes.begin(), passes.end(),
                                    [](const std::string& name) { return name.rfind("ism", 0) != 0; }),
                     passes.end());
        return passes;
    };
    EXPECT_EQ(with(Splat::compute, 64, PullPush::fill), (Passes{"ism squares"}))
        << "holes are filled in the same pass";
    EXPECT_EQ(with(Splat::compute, 128, PullPush::fill), (Passes{"ism squares", "ism pull-push"}));
    EXPECT_EQ(with(Splat::compute, 128, PullPush::off), (Passes{"ism squares"}));
    EXPECT_EQ(with(Splat::points, 64, PullPush::fill), (Passes{"ism points", "ism pull-push"}));
    EXPECT_EQ(with(Splat::disks, 64, PullPush::fill), (Passes{"ism disks"})) << "closed in the same pass";
    EXPECT_EQ(with(Splat::disks, 128, PullPush::fill), (Passes{"ism disks", "ism close"}));
    settings.drop_hull = false;
    EXPECT_EQ(with(Splat::disks, 64, PullPush::fill), (Passes{"ism triangles", "ism disks"}));
}

TEST_F(ExecutedPasses, FurtherBounces) {
    Settings settings;
    settings.show = Show::indirect;
    settings.bounces = 3;
    settings.interleave = 1;
    settings.near_field = false;
    const Passes by_points = {"gbuffer",
                              "rsm: Spot",
                              "points",
                              "vpl importance",
                              "vpls",
                              "ism disks",
                              "vpl importance, next bounce",
                              "vpls, next bounce",
                              "ism disks",
                              "vpl importance, next bounce",
                              "vpls, next bounce",
                              "ism disks",
                              "vpl gather",
                              "composite"};
    EXPECT_EQ(run(occluded_scene(), settings), by_points);
    settings.bounce_source = BounceSource::irsm;
    const Passes splatted = run(occluded_scene(), settings);
    EXPECT_EQ(std::count(splatted.begin(), splatted.end(), "irsm"), 2);
    EXPECT_EQ(std::count(splatted.begin(), splatted.end(), "vpl spacing"), 2) << "splats overlap";
}

TEST_F(ExecutedPasses, PointsAreMovedOnlyWhereSomethingMoved) {
    const scene::Scene scene = occluded_scene();
    Renderer renderer(scene);
    Settings settings;
    settings.width = settings.height = 32;
    const auto moves = [&](const scene::Pose& pose) {
        const Passes passes = renderer.render(pose, camera_from_above(4.0, 10.0), settings).executed;
        return std::count(passes.begin(), passes.end(), "points") == 1;
    };
    scene::Pose pose = scene::evaluate_pose(scene, 0.0);
    EXPECT_TRUE(moves(pose));
    EXPECT_FALSE(moves(pose));
    pose.lights[0].power_w *= 2.0F;
    EXPECT_FALSE(moves(pose)) << "a light moves no surface";
    const auto ball = static_cast<size_t>(pose.draws.back().node);
    pose.world_from_node[ball][3].y += 0.2;
    pose.draws.back().world_from_model[3].y += 0.2;
    EXPECT_TRUE(moves(pose));
    EXPECT_FALSE(moves(pose));
}

TEST_F(ExecutedPasses, OmissionChangesNothing) {
    // A light without power in the scene, and the scene without it: the same bits.
    scene::Scene scene = floor();
    add_light(scene, spot(), glm::translate(glm::dmat4(1.0), glm::dvec3(0.3, 0.0, 2.0)));
    scene::Scene with_dark = scene;
    scene::Light dark = spot();
    dark.power_w = 0.0F;
    add_light(with_dark, dark, glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, 1.0)));
    Settings settings;
    settings.width = settings.height = 32;
    const CameraView camera = camera_from_above(4.0, 10.0);
    EXPECT_EQ(draw(scene, camera, settings).image.rgb, draw(with_dark, camera, settings).image.rgb);
}

TEST_F(ExecutedPasses, SameInputGivesTheSameBits) {
    scene::Scene scene = floor();
    add_light(scene, spot(), glm::translate(glm::dmat4(1.0), glm::dvec3(0.3, 0.0, 2.0)));
    Settings settings;
    settings.width = settings.height = 64;
    const CameraView camera = camera_from_above(4.0, 10.0);
    EXPECT_EQ(draw(scene, camera, settings).image.rgb, draw(scene, camera, settings).image.rgb);
}

}  // namespace
}  // namespace bounce::test
