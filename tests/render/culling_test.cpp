// SPDX-License-Identifier: Apache-2.0
//
// What a frame runs, scene by scene: passes that a scene does not need are not there.
#include <algorithm>

#include "render_fixture.h"

namespace bounce::test {
namespace {

class ExecutedPasses : public ::testing::Test {
  protected:
    void SetUp() override { require_context(); }

    static std::vector<std::string> run(const scene::Scene& scene, Settings settings) {
        settings.width = 32;
        settings.height = 32;
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
