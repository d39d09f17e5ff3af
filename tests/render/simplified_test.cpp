// SPDX-License-Identifier: Apache-2.0
//
// Maps of simplified meshes, by a cube's faces and by the paraboloid's own projection; lights at the points
// of the Halton sequence; bounced light gathered where simplified meshes are seen.
#include "ism_fixture.h"
#include "renderer/presets.h"

namespace bounce::test {
namespace {

constexpr int size = 40;

class SimplifiedMaps : public ::testing::Test {
  protected:
    void SetUp() override { require_context(); }

    // A pointer's light on the wall, a floor that it lights, and a ball between.
    static scene::Scene ball_scene() {
        scene::Scene scene = corner_scene();
        add_pointer(scene);
        add_mesh_node(scene, add_ball(scene, add_diffuse(scene), 0.25F), moved({-1.0, 0.0, 0.75}));
        return scene;
    }
    static Settings with(Visibility visibility, double ratio,
                         MapProjection projection = MapProjection::faces) {
        Settings settings = bounced(size);
        settings.vpls = 16;
        settings.interleave = 1;
        settings.ism_size = 256;
        settings.visibility = visibility;
        settings.simplify = {.ratio = ratio, .error = 0.05};
        settings.map_projection = projection;
        return settings;
    }
    // Pixels darker than half of what they are where nothing hides the lights.
    static double dark_pixels(const scene::Scene& scene, const Settings& settings) {
        Settings none = settings;
        none.visibility = Visibility::none;
        const Rendered open = draw(scene, floor_camera(), none);
        const Rendered r = draw(scene, floor_camera(), settings);
        double count = 0.0;
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                count += r.at(x, y).x < 0.5 * open.at(x, y).x ? 1.0 : 0.0;
            }
        }
        return count;
    }
    static double at_floor(const Rendered& r, double x, double y) {
        const glm::ivec2 p = pixel_of(x, y, size);
        return r.at(p.x, p.y).x;
    }
};

TEST_F(SimplifiedMaps, TheWholeRatioIsTheMapsOfWholeMeshesBitForBit) {
    const scene::Scene scene = ball_scene();
    for (const MapProjection projection : {MapProjection::faces, MapProjection::paraboloid}) {
        const Rendered whole = draw(scene, floor_camera(), with(Visibility::shadow_maps, 0.0, projection));
        const Rendered simplified =
            draw(scene, floor_camera(), with(Visibility::simplified, 1.0, projection));
        EXPECT_EQ(simplified.image.rgb, whole.image.rgb);
        EXPECT_EQ(simplified.report.simplified_triangles, simplified.report.triangles);
        EXPECT_EQ(simplified.report.simplified_error_m, 0.0);
        EXPECT_EQ(whole.report.simplified_triangles, 0U);
    }
}

TEST_F(SimplifiedMaps, AQuarterOfTheTrianglesHidesAboutTheSame) {
    const scene::Scene scene = ball_scene();
    const double whole = dark_pixels(scene, with(Visibility::shadow_maps, 0.0));
    ASSERT_GT(whole, 100.0);
    for (const MapProjection projection : {MapProjection::faces, MapProjection::paraboloid}) {
        const Settings settings = with(Visibility::simplified, 0.25, projection);
        const Rendered r = draw(scene, floor_camera(), settings);
        EXPECT_LE(r.report.simplified_triangles, 4 + (r.report.triangles - 4) / 4);
        EXPECT_GT(r.report.simplified_error_m, 1e-5);
        EXPECT_LT(r.report.simplified_error_m, 0.05 * 0.5);
        // A ball of a quarter of the triangles is smaller by the chords' height, and set back by as much.
        EXPECT_NEAR(dark_pixels(scene, settings) / whole, 1.0, 0.06);
    }
}

TEST_F(SimplifiedMaps, AWallHidesTheLightBehindIt) {
    scene::Scene scene = corner_scene();
    add_pointer(scene);
    add_mesh_node(scene, add_box(scene, {0.05F, 1.9F, 0.6F}, add_diffuse(scene)), moved({-1.0, 0.0, 0.6}));
    for (const MapProjection projection : {MapProjection::faces, MapProjection::paraboloid}) {
        const Settings settings = with(Visibility::simplified, 0.25, projection);
        Settings none = settings;
        none.visibility = Visibility::none;
        const Rendered open = draw(scene, floor_camera(), none);
        const Rendered r = draw(scene, floor_camera(), settings);
        ASSERT_GT(at_floor(open, 0.5, 0.0), 0.0);
        EXPECT_EQ(at_floor(r, 0.5, 0.0), 0.0);
        EXPECT_EQ(at_floor(r, 1.5, 0.5), 0.0);
        EXPECT_NEAR(at_floor(r, -1.6, 0.0) / at_floor(open, -1.6, 0.0), 1.0, 2e-3) << "before it";
    }
}

TEST_F(SimplifiedMaps, ASurfaceIsNotHiddenByWhatItWasSimplifiedTo) {
    // A bowl seen from within, lit on one side: its chords lie before the surface, between it and its lights.
    scene::Scene scene;
    scene.from_blender = true;
    add_mesh_node(scene, add_ball(scene, add_diffuse(scene), 1.5F), glm::dmat4(1.0));
    add_light(scene, light_of(scene::LightType::spot), rotated(70.0, {0.0, 1.0, 0.0}));
    CameraView inside = camera_from_above(1.6, 0.0);
    inside.camera.near_m = 0.0F;
    inside.camera.far_m = 3.0F;
    Settings settings = with(Visibility::none, 0.0);
    settings.vpls = 64;
    const double open = draw(scene, inside, settings).mean();
    ASSERT_GT(open, 0.0);
    settings.visibility = Visibility::simplified;
    settings.simplify = {.ratio = 0.2, .error = 0.05};
    for (const MapProjection projection : {MapProjection::faces, MapProjection::paraboloid}) {
        settings.map_projection = projection;
        EXPECT_GT(draw(scene, inside, settings).mean() / open, 0.9);
    }
}

TEST_F(SimplifiedMaps, WhatDeformsIsSimplifiedAsItStands) {
    scene::Scene scene = corner_scene();
    add_pointer(scene);
    const int ball = add_ball(scene, add_diffuse(scene), 0.25F);
    scene::Primitive& primitive = scene.meshes[static_cast<size_t>(ball)].primitives[0];
    scene::MorphTarget aside;
    aside.positions.assign(primitive.positions.size(), glm::vec3(0.0F, 1.0F, 0.0F));
    primitive.targets = {aside};
    scene.meshes[static_cast<size_t>(ball)].weights = {1.0F};
    add_mesh_node(scene, ball, moved({-1.0, 0.0, 0.75}));
    const Settings settings = with(Visibility::simplified, 0.25);
    Settings none = settings;
    none.visibility = Visibility::none;
    const Rendered open = draw(scene, floor_camera(), none);
    const Rendered r = draw(scene, floor_camera(), settings);
    EXPECT_NEAR(at_floor(r, 0.0, 0.0) / at_floor(open, 0.0, 0.0), 1.0, 2e-3) << "where it is modelled";
    // From (-2, 0, 1.5) through (-1, 1, 0.75) to the floor's (0, 2, 0): the shadow's near half is in sight.
    EXPECT_EQ(at_floor(r, -0.15, 1.85), 0.0) << "where it has moved to";
}

TEST_F(SimplifiedMaps, HybridShadingOfWholeMeshesIsDeferredShading) {
    scene::Scene scene = ball_scene();
    scene.render.film_exposure = 2.0F;  // once
    Settings settings = preset_settings(Preset::lv2009);
    settings.width = settings.height = size;
    settings.vpls = 16;
    settings.ism_size = 64;
    settings.show = Show::indirect;
    settings.simplify.ratio = 1.0;
    const Rendered deferred = draw(scene, floor_camera(), settings);
    settings.shading = Shading::hybrid;
    const Rendered hybrid = draw(scene, floor_camera(), settings);
    // The same sum, divided by the scale of half floats before or after it is stored.
    for (size_t i = 0; i < hybrid.image.rgb.size(); ++i) {
        ASSERT_NEAR(hybrid.image.rgb[i], deferred.image.rgb[i], 1e-5F * deferred.image.rgb[i]) << i;
    }
    ASSERT_GT(deferred.mean(), 0.0);
}

TEST_F(SimplifiedMaps, HybridShadingShowsTheSimplifiedMeshUnderTheLight) {
    // The outline of a coarse ball: pixels of the ball next to it show the floor's light, and the direct
    // light is that of the whole ball.
    scene::Scene scene = ball_scene();
    Settings settings = preset_settings(Preset::lv2009);
    settings.width = settings.height = 160;
    settings.vpls = 16;
    settings.ism_size = 64;
    settings.antialias = false;
    settings.simplify = {.ratio = 0.03, .error = 0.2};
    const CameraView close = camera_from_above(1.0, 5.0);
    CameraView over = close;
    over.world_from_camera = glm::translate(glm::dmat4(1.0), glm::dvec3(-1.0, 0.0, 5.0));
    const auto shown = [&](Shading shading, Show show) {
        Settings of = settings;
        of.shading = shading;
        of.show = show;
        return draw(scene, over, of).image.rgb;
    };
    EXPECT_EQ(shown(Shading::hybrid, Show::direct), shown(Shading::deferred, Show::direct));
    EXPECT_NE(shown(Shading::hybrid, Show::indirect), shown(Shading::deferred, Show::indirect));
}

// Mean bounced light of lights at Halton's points over that of lights in cells of equal flux.
double uniform_over_cells(const scene::Scene& scene) {
    Settings settings = bounced(size);
    settings.visibility = Visibility::none;
    settings.near_field = false;
    settings.glossy_bounces = false;
    settings.interleave = 1;
    settings.vpls = 2048;
    const double cells = draw(scene, floor_camera(), settings).mean();
    settings.vpl_sampling = VplSampling::uniform;
    return draw(scene, floor_camera(), settings).mean() / cells;
}

TEST_F(SimplifiedMaps, LightsAtHaltonsPointsHaveAllOfTheFlux) {
    scene::Scene scene = corner_scene();
    EXPECT_NEAR(uniform_over_cells([&] {
                    scene::Scene spot = scene;
                    add_wall_spot(spot);
                    return spot;
                }()),
                1.0, 0.02);
    EXPECT_NEAR(uniform_over_cells([&] {
                    scene::Scene point = scene;
                    add_light(point, light_of(scene::LightType::point), moved({0.5, 0.0, 1.0}));
                    return point;
                }()),
                1.0, 0.02);
    EXPECT_NEAR(uniform_over_cells([&] {
                    scene::Scene sun = scene;
                    add_light(sun, light_of(scene::LightType::sun), rotated(50.0, {0.0, 1.0, 0.0}));
                    return sun;
                }()),
                1.0, 0.02);
    // Of two lights each has its part.
    EXPECT_NEAR(uniform_over_cells([&] {
                    scene::Scene both = scene;
                    add_wall_spot(both);
                    scene::Light dim = light_of(scene::LightType::point);
                    dim.power_w = 20.0F;
                    add_light(both, dim, moved({-1.0, 1.0, 0.5}));
                    return both;
                }()),
                1.0, 0.02);
}

TEST_F(SimplifiedMaps, PresetRunsThePaperStepsAndNoOther) {
    const scene::Scene scene = ball_scene();
    Settings settings = preset_settings(Preset::lv2009);
    settings.width = settings.height = 32;
    settings.vpls = 16;
    settings.ism_size = 32;
    settings.antialias = false;
    using Passes = std::vector<std::string>;
    EXPECT_EQ(draw(scene, floor_camera(), settings).report.executed,
              (Passes{"gbuffer", "shadow map: ", "direct light: ", "rsm: ", "vpls", "paraboloid maps",
                      "vpl gather", "composite"}));
    settings.shading = Shading::hybrid;
    settings.map_projection = MapProjection::faces;
    EXPECT_EQ(draw(scene, floor_camera(), settings).report.executed,
              (Passes{"gbuffer", "gbuffer, simplified", "shadow map: ", "direct light: ", "rsm: ", "vpls",
                      "classic maps", "vpl gather", "reflected light", "composite"}));
}

}  // namespace
}  // namespace bounce::test
