// SPDX-License-Identifier: Apache-2.0
//
// Debug layers: each shows what it says, and runs what it shows and nothing else.
#include <algorithm>

#include <gmock/gmock.h>

#include "render_fixture.h"

namespace bounce::test {
namespace {

using Passes = std::vector<std::string>;
using testing::Contains;
using testing::Not;
using testing::StartsWith;

// A floor lit in one spot at x = 1.2, a wall that leans away from it at x = -1.5, and between them, seen
// edge-on from above, a screen.
class Layers : public ::testing::Test {
  protected:
    void SetUp() override { require_context(); }

    static scene::Scene room(bool screen) {
        scene::Scene scene;
        scene.from_blender = true;
        const int white = add_diffuse(scene);
        const auto at = [](double x, double y, double z) {
            return glm::translate(glm::dmat4(1.0), {x, y, z});
        };
        add_mesh_node(scene, add_square(scene, 4.0F, white), glm::dmat4(1.0));
        // Towards +x and +z.
        add_mesh_node(
            scene, add_square(scene, 1.0F, white),
            at(-1.5, 0.0, 0.6) * glm::rotate(glm::dmat4(1.0), 0.25 * pi, glm::dvec3(0.0, 1.0, 0.0)));
        if (screen) {
            add_mesh_node(
                scene, add_square(scene, 3.0F, white),
                at(0.0, 0.0, 1.0) * glm::rotate(glm::dmat4(1.0), 0.5 * pi, glm::dvec3(0.0, 1.0, 0.0)));
        }
        scene::Light spot;
        spot.name = "Spot";
        spot.type = scene::LightType::spot;
        spot.power_w = 100.0F;
        spot.cone_angle_rad = 0.25F;
        add_light(scene, spot, at(1.2, 0.0, 3.0));
        return scene;
    }

    static Settings settings(Show show) {
        Settings out;
        out.width = out.height = 64;
        out.show = show;
        out.vpls = 16;
        out.ism_size = 32;
        out.drop_hull = false;
        return out;
    }
    static Rendered show(const Settings& settings, bool screen = true) {
        return draw(room(screen), camera_from_above(4.0, 10.0), settings);
    }
    // Pixels of the leaning wall, 4 m to 64 pixels.
    template <typename Visit>
    static void for_each_on_wall(const Visit& visit) {
        for (int y = 28; y < 36; ++y) {
            for (int x = 6; x < 10; ++x) {
                visit(x, y);
            }
        }
    }
};

TEST_F(Layers, DotsStandWhereTheSpotShines) {
    const Rendered out = show(settings(Show::vpls));
    EXPECT_EQ(out.report.executed.back(), "vpl view");
    int bright = 0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const glm::dvec3 color = out.at(x, y);
            if (std::max({color.r, color.g, color.b}) > 0.5) {
                ++bright;
                // The cone's half angle 0.125 at 3 m reaches 0.38 m, 6 pixels; a dot's radius is 2.5.
                EXPECT_LT(std::hypot(x - 51.2, y - 32.0), 6.0 + 4.0) << x << " " << y;
            }
        }
    }
    EXPECT_GT(bright, 16) << "at least a pixel for each of 16 lights";
    // Without dots nothing of the dimmed picture is that bright.
    Settings other = settings(Show::vpls);
    other.bounces = 2;
    other.bounce_vpls = 16;
    other.shown_bounce = 2;
    const Rendered second = show(other);
    EXPECT_NE(second.image.rgb, out.image.rgb) << "--bounce chooses whose lights are shown";
}

TEST_F(Layers, AMapAloneNeedsNoPicture) {
    Settings one = settings(Show::ism);
    one.shown_vpl = 0;
    const Rendered out = show(one);
    EXPECT_EQ(out.report.executed.front(), "rsm: Spot");
    EXPECT_EQ(out.report.executed.back(), "ism view");
    for (const char* unneeded :
         {"gbuffer", "shadow map: Spot", "direct light: Spot", "vpl gather", "composite"}) {
        EXPECT_THAT(out.report.executed, Not(Contains(unneeded)));
    }
    EXPECT_EQ(out.at(0, 0), glm::dvec3(0.0)) << "outside the hemisphere";
    // The screen stands in the map as grey; beside it nothing was hit.
    int grey = 0;
    int empty = 0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const glm::dvec3 color = out.at(x, y);
            grey += color.r > 0.0 && color.r == color.b ? 1 : 0;
            empty += color.b > 2.0 * color.r ? 1 : 0;
        }
    }
    EXPECT_GT(grey, 200);
    EXPECT_GT(empty, 200);
}

TEST_F(Layers, TheWholeAtlasHasAllMaps) {
    const Rendered out = show(settings(Show::ism));  // 4 x 4 maps, 16 pixels each
    for (int map = 0; map < 16; ++map) {
        const glm::dvec3 middle = out.at(map % 4 * 16 + 8, map / 4 * 16 + 8);
        EXPECT_GT(middle.b, 0.0) << "map " << map;
    }
    EXPECT_EQ(out.report.map_size, 32);
    EXPECT_EQ(out.report.atlas_width, 128);
    EXPECT_EQ(out.report.vpls, 16);
}

TEST_F(Layers, PullPushFillsWhatSplatsLeave) {
    Settings splats = settings(Show::ism_splats);
    splats.splat = Splat::compute;
    splats.pull_push = PullPush::fill;
    splats.ism_points = 128;
    splats.shown_vpl = 0;
    Settings filled = splats;
    filled.show = Show::ism;
    const auto hit = [](const Rendered& picture) {
        int count = 0;
        for (size_t i = 0; i < picture.image.rgb.size(); i += 3) {
            count += picture.image.rgb[i] > 0.0F && picture.image.rgb[i] == picture.image.rgb[i + 2] ? 1 : 0;
        }
        return count;
    };
    const int before = hit(show(splats));
    EXPECT_GT(before, 0);
    EXPECT_GT(hit(show(filled)), before);
}

TEST_F(Layers, VisibilityIsBlueBehindTheScreen) {
    const Rendered hidden = show(settings(Show::vpl_visibility));
    for_each_on_wall(
        [&](int x, int y) { EXPECT_GT(hidden.at(x, y).b, 1.5 * hidden.at(x, y).r) << x << " " << y; });
    EXPECT_EQ(hidden.report.executed.back(), "vpl view");
    EXPECT_THAT(hidden.report.executed, Not(Contains("vpl gather")));
    EXPECT_THAT(hidden.report.executed, Not(Contains(StartsWith("direct light"))));
    const Rendered lit = show(settings(Show::vpl_visibility), false);
    for_each_on_wall([&](int x, int y) { EXPECT_GT(lit.at(x, y).r, 1.5 * lit.at(x, y).b) << x << " " << y; });
    // The floor lies in the plane of the light on it: neither.
    const glm::dvec3 floor = lit.at(32, 10);
    EXPECT_NEAR(floor.r, floor.b, 1e-3);
}

TEST_F(Layers, TheBlurTakesThePatternAndKeepsTheLight) {
    Settings unblurred = settings(Show::unblurred);
    unblurred.near_field = false;
    Settings blurred = unblurred;
    blurred.show = Show::indirect;
    const Rendered raw = show(unblurred, false);
    const Rendered smooth = show(blurred, false);
    double raw_steps = 0.0;
    double smooth_steps = 0.0;
    double raw_sum = 0.0;
    double smooth_sum = 0.0;
    for_each_on_wall([&](int x, int y) {
        raw_steps += std::abs(raw.at(x, y).r - raw.at(x + 1, y).r);
        smooth_steps += std::abs(smooth.at(x, y).r - smooth.at(x + 1, y).r);
        raw_sum += raw.at(x, y).r;
        smooth_sum += smooth.at(x, y).r;
    });
    EXPECT_GT(raw_steps, 2.0 * smooth_steps);
    EXPECT_NEAR(raw_sum, smooth_sum,
                0.1 * smooth_sum);  // 8 x 4 pixels are two whole blocks; the blur looks beyond
    EXPECT_THAT(raw.report.executed, Not(Contains(StartsWith("blur"))));
    EXPECT_THAT(raw.report.executed, Not(Contains(StartsWith("direct light"))));
}

TEST_F(Layers, RemovedLightIsWhatTheReportSays) {
    Settings removed = settings(Show::removed);
    removed.near_field = false;
    removed.interleave = 1;
    removed.measure_removed = true;
    removed.antialias = false;  // its filter reaches beyond the picture, where nothing is lit
    const Rendered out = show(removed, false);
    ASSERT_TRUE(out.report.removed.has_value());
    EXPECT_GT(out.report.removed->removed, 0.0);
    EXPECT_NEAR(out.report.removed->removed, out.mean(), 1e-3 * out.mean());
    EXPECT_LT(out.report.removed->bias(), 0.0);
    removed.show = Show::indirect;
    const Rendered indirect = show(removed, false);
    EXPECT_NEAR(indirect.report.removed->indirect, indirect.mean(), 1e-3 * indirect.mean());
    EXPECT_DOUBLE_EQ(indirect.report.removed->removed, out.report.removed->removed);
    // The near field gathers that light, so nothing is bounded.
    removed.near_field = true;
    EXPECT_EQ(show(removed, false).report.removed->removed, 0.0);
}

TEST_F(Layers, WithoutMeasuringNothingIsRead) {
    const Rendered out = show(settings(Show::shaded));
    EXPECT_FALSE(out.report.removed.has_value());
    for (const char* costly : {"removed light", "vpl gather, removed", "reflected flux"}) {
        EXPECT_THAT(out.report.executed, Not(Contains(costly)));
    }
}

TEST_F(Layers, ALightThatReachesNothingIsFoundAndSaid) {
    scene::Scene scene = room(true);
    // Up, away from everything.
    scene.nodes.back().matrix = glm::translate(glm::dmat4(1.0), glm::dvec3(1.2, 0.0, 3.0)) *
                                glm::rotate(glm::dmat4(1.0), pi, glm::dvec3(1.0, 0.0, 0.0));
    Settings find = settings(Show::shaded);
    find.find_unlit = true;
    const Rendered dark = draw(scene, camera_from_above(4.0, 10.0), find);
    EXPECT_EQ(dark.mean(), 0.0);
    ASSERT_EQ(dark.report.notes.size(), 1U);
    EXPECT_THAT(dark.report.notes[0], testing::HasSubstr("no light reaches a surface"));
    EXPECT_TRUE(show(find).report.notes.empty()) << "a lit scene has nothing to say";
}

TEST_F(Layers, ACameraThatSeesNothingIsFoundAndSaid) {
    Settings find = settings(Show::shaded);
    find.find_unlit = true;
    CameraView away = camera_from_above(4.0, 10.0);
    away.world_from_camera =
        away.world_from_camera * glm::rotate(glm::dmat4(1.0), pi, glm::dvec3(1.0, 0.0, 0.0));
    const Rendered dark = draw(room(true), away, find);
    EXPECT_EQ(dark.mean(), 0.0);
    EXPECT_THAT(dark.report.notes, Contains(testing::HasSubstr("sees no surface")));
}

TEST_F(Layers, ScenesWithoutAPointStillDraw) {
    // Triangles without area, many bounces: no point to splat or to draw lights from.
    scene::Scene scene;
    scene.from_blender = true;
    add_mesh_node(scene, add_square(scene, 0.0F, add_diffuse(scene)), glm::dmat4(1.0));
    scene::Light spot;
    spot.name = "Spot";
    spot.type = scene::LightType::spot;
    spot.power_w = 100.0F;
    spot.cone_angle_rad = 1.0F;
    add_light(scene, spot, glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, 2.0)));
    for (const int bounces : {1, 3}) {
        Settings find = settings(Show::shaded);
        find.find_unlit = true;
        find.bounces = bounces;
        const Rendered out = draw(scene, camera_from_above(4.0, 10.0), find);
        EXPECT_EQ(out.mean(), 0.0);
        EXPECT_FALSE(out.report.notes.empty());
    }
}

}  // namespace
}  // namespace bounce::test
