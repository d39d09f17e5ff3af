// SPDX-License-Identifier: Apache-2.0
//
// Bounced light of large area lights, from several places on each, against a sum over the light and the wall.
#include <algorithm>
#include <cstdio>

#include "ism_fixture.h"

namespace bounce::test {
namespace {

constexpr int k_side = 16;
constexpr double k_frame_m = 4.0;

class BouncePlaces : public ::testing::Test {
  protected:
    void SetUp() override { require_context(); }
};

scene::Light panel() {
    scene::Light light;
    light.name = "Panel";
    light.type = scene::LightType::area;
    light.power_w = 100.0F;
    light.size_x_m = 2.0F;
    light.size_y_m = 3.2F;
    return light;
}

scene::Light spot() {
    scene::Light light;
    light.name = "Spot";
    light.type = scene::LightType::spot;
    light.power_w = 30.0F;
    light.cone_angle_rad = 0.6F;
    return light;
}

// Before the wall, and looking at it.
constexpr double k_before_wall_m = 0.5;
const glm::dvec3 k_panel_middle{k_before_wall_m - 2.0, 0.0, 1.6};

// X is up, Y along the wall, -Z towards the wall.
glm::dmat4 world_from_panel() {
    return glm::dmat4({0, 0, 1, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}, glm::dvec4(k_panel_middle, 1.0));
}

// A floor and a wall at x = -2, of 4 m a side each.
scene::Scene lit_corner(const scene::Light& light, const glm::dmat4& matrix) {
    scene::Scene scene;
    scene.from_blender = true;
    const int square = add_square(scene, 4.0F, add_diffuse(scene, glm::vec3(0.8F)));
    add_mesh_node(scene, square, glm::dmat4(1.0));
    add_mesh_node(scene, square, rotated(90.0, {0.0, 1.0, 0.0}, {-2.0, 0.0, 2.0}));
    add_light(scene, light, matrix);
    return scene;
}

Settings settings_of(Technique technique, int places) {
    Settings settings;
    settings.width = settings.height = k_side;
    settings.technique = technique;
    settings.show = Show::indirect;
    settings.rsm_full_sum = technique == Technique::rsm;
    settings.antialias = false;  // pixel by pixel
    settings.interpolate = false;
    settings.vpls = 128;
    settings.interleave = 1;
    settings.bounce_places = places;
    return settings;
}

glm::dvec3 floor_at(int x, int y) {
    return {((x + 0.5) / k_side - 0.5) * k_frame_m, (0.5 - (y + 0.5) / k_side) * k_frame_m, 0.0};
}

// What the panel gives to a place of the wall, W/m^2: L = P/(4A), summed over pieces of it.
double wall_irradiance(const glm::dvec3& wall) {
    constexpr int pieces = 24;
    const scene::Light light = panel();
    double sum = 0.0;
    for (int i = 0; i < pieces * pieces; ++i) {
        const glm::dvec3 at =
            k_panel_middle + glm::dvec3(0.0, light.size_y_m * ((i / pieces + 0.5) / pieces - 0.5),
                                        light.size_x_m * ((i % pieces + 0.5) / pieces - 0.5));
        const glm::dvec3 d = wall - at;
        const double squared = glm::dot(d, d);
        sum += d.x * d.x / (squared * squared);  // both cosines are |x|/d
    }
    return light.power_w / 4.0 * sum / (pieces * pieces);
}

// The radiance of the floor by the wall's light: 0.8/pi times the integral of 0.8/pi E cos cos / d^2.
std::vector<double> floor_radiance() {
    constexpr int pieces = 96;
    const double cell = 4.0 / pieces;
    std::vector<double> out(k_side * k_side, 0.0);
    for (int i = 0; i < pieces * pieces; ++i) {
        const glm::dvec3 wall(-2.0, (i % pieces + 0.5) * cell - 2.0, (i / pieces + 0.5) * cell);
        const double sent = 0.8 / pi * wall_irradiance(wall) * cell * cell;
        for (int p = 0; p < k_side * k_side; ++p) {
            const glm::dvec3 d = floor_at(p % k_side, p / k_side) - wall;
            const double squared = glm::dot(d, d);
            out[static_cast<size_t>(p)] += 0.8 / pi * sent * d.x * -d.z / (squared * squared);
        }
    }
    return out;
}

struct Error {
    double worst = 0.0;
    double mean = 0.0;  // of all pixels together
};

// Relative; the columns next to the wall are left out, where a pixel's middle says little about it.
Error floor_error(const Rendered& picture) {
    static const std::vector<double> expected = floor_radiance();
    Error out;
    double got = 0.0;
    double wanted = 0.0;
    for (int y = 0; y < k_side; ++y) {
        for (int x = 2; x < k_side; ++x) {
            const double want = expected[static_cast<size_t>(y * k_side + x)];
            out.worst = std::max(out.worst, std::abs(picture.at(x, y).x / want - 1.0));
            got += picture.at(x, y).x;
            wanted += want;
        }
    }
    out.mean = got / wanted - 1.0;
    return out;
}

Error panel_error(Technique technique, int places) {
    const Error out = floor_error(draw(lit_corner(panel(), world_from_panel()),
                                       camera_from_above(k_frame_m, 50.0), settings_of(technique, places)));
    std::printf("technique %d, %2d places: worst %.4f, mean %+.4f\n", static_cast<int>(technique), places,
                out.worst, out.mean);
    return out;
}

TEST_F(BouncePlaces, OfAPanelBeforeAWallAreNearTheIntegral) {
    // Half a metre before the wall four places are still four hot spots; that is what the tolerance allows.
    // One is off by several times as much.
    const Error one = panel_error(Technique::rsm, 1);
    const Error four = panel_error(Technique::rsm, 4);
    const Error sixteen = panel_error(Technique::rsm, 16);
    EXPECT_GT(one.worst, 0.3);
    EXPECT_GT(one.mean, 0.1);
    EXPECT_LT(four.worst, 0.16);
    EXPECT_LT(std::abs(four.mean), 0.025);
    EXPECT_LT(sixteen.worst, 0.04);
    EXPECT_LT(std::abs(sixteen.mean), 0.01);
}

TEST_F(BouncePlaces, LoseNoLightAsVirtualPointLights) {
    // Lights of all places stand on the same wall: if each counted all of it as its own, the near field and
    // what bounds the lights would lose light with the number of places: a fifth of it with 16. Against the
    // full sum from the same places, whose own error is above. Few lights, which show it most, are coarse
    // this near to the floor: 1 % off from one place, 6 % from more.
    for (const int places : {1, 4, 16}) {
        const double sum = panel_error(Technique::rsm, places).mean;
        const double vpls = panel_error(Technique::ism, places).mean;
        EXPECT_NEAR((1.0 + vpls) / (1.0 + sum), 1.0, 0.09) << places;
    }
}

std::vector<std::string> maps_in(const std::vector<std::string>& passes) {
    std::vector<std::string> out;
    std::copy_if(passes.begin(), passes.end(), std::back_inserter(out),
                 [](const std::string& pass) { return pass.starts_with("rsm: "); });
    return out;
}

TEST_F(BouncePlaces, HaveAMapEach) {
    const Rendered r = draw(lit_corner(panel(), world_from_panel()), camera_from_above(k_frame_m, 50.0),
                            settings_of(Technique::ism, 4));
    EXPECT_EQ(maps_in(r.report.executed),
              (std::vector<std::string>{"rsm: Panel, place 1 of 4", "rsm: Panel, place 2 of 4",
                                        "rsm: Panel, place 3 of 4", "rsm: Panel, place 4 of 4"}));
    EXPECT_EQ(r.report.lights, 1);
}

TEST_F(BouncePlaces, SmallLightsHaveNone) {
    // An area light below four tenths of the scene's diagonal, and a point with a large radius.
    scene::Light small = panel();
    small.size_x_m = small.size_y_m = 0.3F;
    scene::Light ball = panel();
    ball.type = scene::LightType::point;
    ball.radius_m = 1.0F;
    for (const scene::Light& light : {small, ball}) {
        const scene::Scene scene = lit_corner(light, world_from_panel());
        const CameraView camera = camera_from_above(k_frame_m, 50.0);
        for (const Technique technique : {Technique::rsm, Technique::ism}) {
            const Rendered one = draw(scene, camera, settings_of(technique, 1));
            const Rendered four = draw(scene, camera, settings_of(technique, 4));
            EXPECT_EQ(one.report.executed, four.report.executed);
            EXPECT_EQ(one.image.rgb, four.image.rgb);
        }
    }
}

TEST_F(BouncePlaces, LayersStillCountLights) {
    scene::Scene scene = lit_corner(panel(), world_from_panel());
    scene::Light taking = spot();
    taking.name = "Thief";
    taking.power_w = -5.0F;  // has no map, and so no number
    add_light(scene, taking, moved({0.0, 0.0, 3.0}));
    add_light(scene, spot(), moved({0.5, 0.0, 3.0}));
    const auto shown = [&](int light, int places) {
        Settings settings = settings_of(Technique::ism, places);
        settings.show = Show::rsm_flux;
        settings.shown_light = light;
        return draw(scene, camera_from_above(k_frame_m, 50.0), settings);
    };
    EXPECT_EQ(maps_in(shown(0, 4).report.executed), std::vector<std::string>{"rsm: Panel, place 1 of 4"});
    EXPECT_EQ(maps_in(shown(1, 4).report.executed), std::vector<std::string>{"rsm: Spot"});
    EXPECT_EQ(shown(1, 4).image.rgb, shown(1, 1).image.rgb);
}

}  // namespace
}  // namespace bounce::test
