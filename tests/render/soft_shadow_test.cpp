// SPDX-License-Identifier: Apache-2.0
//
// Shadows of lights with a size, against closed forms of what a half plane leaves of them.
#include <functional>

#include <gmock/gmock.h>

#include "render_fixture.h"

namespace bounce::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr int k_pixels = 129;
constexpr double k_width = 0.6;         // of the frame, metres
constexpr double k_edge_height = 0.25;  // of the half plane over the floor
constexpr double k_light_height = 2.0;
constexpr double k_light_x =
    -0.8;  // on the side of the half plane, whose shadow then comes out from under it

// Of one of 64 places, each of which is there or not, and an edge smoothed over a pixel: worst pixel and
// mean.
constexpr double k_worst = 0.03;
// Places in a ball are even in three dimensions, and less so in the one across an edge.
constexpr double k_worst_ball = 0.055;
constexpr double k_mean = 0.006;

class SoftShadows : public ::testing::Test {
  protected:
    void SetUp() override { require_context(); }

    // A floor, and where asked for a half plane over its part x < 0 (four metres of it).
    static scene::Scene scene_with(const scene::Light& light, const glm::dmat4& world_from_light,
                                   bool occluder) {
        scene::Scene scene;
        scene.from_blender = true;
        const int material = add_diffuse(scene);
        add_mesh_node(scene, add_square(scene, 6.0F, material), glm::dmat4(1.0));
        if (occluder) {
            add_mesh_node(scene, add_square(scene, 4.0F, material),
                          glm::translate(glm::dmat4(1.0), glm::dvec3(-2.0, 0.0, k_edge_height)));
        }
        add_light(scene, light, world_from_light);
        return scene;
    }
    static Settings settings() {
        Settings s;
        s.width = s.height = k_pixels;
        s.technique = Technique::direct;
        return s;
    }
};

glm::dmat4 overhead() {
    return glm::translate(glm::dmat4(1.0), glm::dvec3(k_light_x, 0.0, k_light_height));
}

scene::Light light_of(scene::LightType type) {
    scene::Light light;
    light.name = "light";
    light.type = type;
    light.power_w = 100.0F;
    light.irradiance_w_m2 = 2.0F;
    light.cone_angle_rad = 1.6F;
    return light;
}

// What part of the light arrives, over the pixels right of the edge: against `expected` of the place.
void expect_penumbra(const Rendered& shaded, const Rendered& lit,
                     const std::function<double(double)>& expected, const std::string& what,
                     double worst = k_worst, double mean = k_mean) {
    double sum = 0.0;
    int count = 0;
    bool umbra = false;
    bool all_lit = false;
    for (int x = k_pixels / 2 + 2; x < k_pixels; ++x) {
        const double at = ((x + 0.5) / k_pixels - 0.5) * k_width;
        const double got = shaded.at(x, k_pixels / 2).x / lit.at(x, k_pixels / 2).x;
        const double want = expected(at);
        EXPECT_NEAR(got, want, worst) << what << " at x = " << at;
        sum += got - want;
        ++count;
        umbra |= want == 0.0;
        all_lit |= want == 1.0;
    }
    EXPECT_NEAR(sum / count, 0.0, mean) << what;
    EXPECT_TRUE(umbra && all_lit) << what << ": the frame holds the whole penumbra";
}

// Where the edge is seen from a place of the floor, at the light's height.
double edge_at_light(double x) {
    return -x * (k_light_height - k_edge_height) / k_edge_height;
}

// Form factor from a small floor piece below the origin to a parallel rectangle [0, x] x [0, y] at height 1,
// odd in both (Howell, "A Catalog of Radiation Heat Transfer Configuration Factors", B-3).
double corner(double x, double y) {
    const double a = std::sqrt(1.0 + x * x);
    const double b = std::sqrt(1.0 + y * y);
    return (x / a * std::atan(y / a) + y / b * std::atan(x / b)) / (2.0 * pi);
}

// Part of the irradiance of a rectangle of 0.9 x 0.5 m that the half plane leaves at a place of the floor.
double rectangle_beyond_edge(double x) {
    const auto strip = [x](double from, double to) {
        const double y = 0.25 / k_light_height;
        return 2.0 * (corner((to - x) / k_light_height, y) - corner((from - x) / k_light_height, y));
    };
    const double low = k_light_x - 0.45;
    const double high = k_light_x + 0.45;
    const double edge = std::clamp(edge_at_light(x), low, high);
    return strip(edge, high) / strip(low, high);
}

TEST_F(SoftShadows, AHalfPlaneLeavesItsPartOfARectangle) {
    scene::Light light = light_of(scene::LightType::area);
    light.shape = scene::AreaShape::rectangle;
    light.size_x_m = 0.9F;
    light.size_y_m = 0.5F;
    const CameraView camera = camera_from_above(k_width, 10.0);
    const Rendered shaded = draw(scene_with(light, overhead(), true), camera, settings());
    const Rendered lit = draw(scene_with(light, overhead(), false), camera, settings());
    EXPECT_THAT(shaded.report.executed, Contains("soft shadow: light"));
    expect_penumbra(shaded, lit, rectangle_beyond_edge, "rectangle");
}

// Part of a unit disk's area beyond a chord at u.
double beyond_chord(double u) {
    return (std::acos(u) - u * std::sqrt(1.0 - u * u)) / pi;
}

TEST_F(SoftShadows, AHalfPlaneLeavesItsPartOfALightWithARadius) {
    for (const auto type : {scene::LightType::point, scene::LightType::spot}) {
        scene::Light light = light_of(type);
        light.radius_m = 0.3F;
        const CameraView camera = camera_from_above(k_width, 10.0);
        const Rendered shaded = draw(scene_with(light, overhead(), true), camera, settings());
        const Rendered lit = draw(scene_with(light, overhead(), false), camera, settings());
        expect_penumbra(
            shaded, lit,
            [&](double x) {
                // The angle between the edge and the light's middle, both seen from x, on a disk that faces
                // x. The light is near: its half angle is 8 degrees, whose tangent and sine differ by a
                // percent.
                const double to_light = std::atan2(k_light_x - x, k_light_height);
                const double to_edge = std::atan2(-x, k_edge_height);
                const double distance = std::hypot(k_light_x - x, k_light_height);
                const double u = std::clamp(std::tan(to_edge - to_light) * distance / 0.3, -1.0, 1.0);
                return beyond_chord(u);
            },
            type == scene::LightType::point ? "point" : "spot", k_worst_ball);
    }
}

TEST_F(SoftShadows, AHalfPlaneLeavesItsPartOfASun) {
    scene::Light light = light_of(scene::LightType::sun);
    light.angle_rad = static_cast<float>(12.0 * pi / 180.0);
    const double tilt = 0.6;  // towards -x
    const glm::dmat4 tilted = glm::rotate(glm::dmat4(1.0), -tilt, glm::dvec3(0.0, 1.0, 0.0));
    const CameraView camera = camera_from_above(k_width, 10.0);
    const Rendered shaded = draw(scene_with(light, tilted, true), camera, settings());
    const Rendered lit = draw(scene_with(light, tilted, false), camera, settings());
    const double radius = std::tan(0.5 * static_cast<double>(light.angle_rad));
    expect_penumbra(
        shaded, lit,
        [&](double x) {
            const double to_edge = std::atan2(-x, k_edge_height);
            const double u = std::clamp(std::tan(to_edge + tilt) / radius, -1.0, 1.0);
            // The floor's cosine over the disk: cos tilt + u radius sin tilt; its first moment beyond a chord
            // is 2/3 (1 - u^2)^(3/2).
            const double moment = 2.0 / (3.0 * pi) * std::pow(1.0 - u * u, 1.5);
            return beyond_chord(u) + moment * radius * std::tan(tilt);
        },
        "sun");
}

TEST_F(SoftShadows, NothingShadowsItself) {
    // One floor and no occluder: the picture is the one without shadows. Not a rounding more: where all maps
    // see the light nothing is multiplied.
    for (const auto type :
         {scene::LightType::spot, scene::LightType::point, scene::LightType::sun, scene::LightType::area}) {
        for (const double degrees : {0.0, 40.0, 75.0}) {
            scene::Light light = light_of(type);
            light.radius_m = 0.4F;
            light.angle_rad = 0.1F;
            light.size_x_m = 1.0F;
            light.size_y_m = 0.3F;
            light.shape = scene::AreaShape::ellipse;
            const glm::dmat4 tilted =
                glm::rotate(glm::dmat4(1.0), degrees * pi / 180.0, glm::dvec3(0.0, 1.0, 0.0));
            const glm::dmat4 at = glm::translate(tilted, glm::dvec3(0.0, 0.0, 3.0));
            const CameraView camera = camera_from_above(4.0, 10.0);
            const Rendered with_shadow = draw(scene_with(light, at, false), camera, settings());
            light.cast_shadow = false;
            const Rendered without = draw(scene_with(light, at, false), camera, settings());
            EXPECT_GT(without.mean(), 0.0);
            EXPECT_EQ(with_shadow.image.rgb, without.image.rgb)
                << "type " << static_cast<int>(type) << " at " << degrees << " degrees";
        }
    }
}

TEST_F(SoftShadows, ALightAmongWhatItLightsTakesACubeWithTheSamePenumbra) {
    // A wall at the frame's edge reaches above the light, so that no one picture holds all that it lights.
    for (const auto type : {scene::LightType::point, scene::LightType::area}) {
        scene::Light light = light_of(type);
        light.radius_m = 0.3F;
        light.size_x_m = light.size_y_m = 0.5F;
        const CameraView camera = camera_from_above(1.2, 10.0);
        scene::Scene scene = scene_with(light, overhead(), true);
        const glm::dmat4 upright = glm::rotate(glm::dmat4(1.0), 0.5 * pi, glm::dvec3(1.0, 0.0, 0.0));
        add_mesh_node(scene, add_square(scene, 5.0F, 0),
                      glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.59, 2.6)) * upright);
        Settings fine = settings();
        fine.soft_shadow_size = 1024;
        fine.shadow_samples = 16;  // the same ones, in maps as fine
        Settings few = settings();
        few.shadow_samples = 16;
        const Rendered want = draw(scene_with(light, overhead(), true), camera, few);
        const Rendered got = draw(scene, camera, fine);
        const double lit = want.at(k_pixels - 1, k_pixels / 2).x;
        double sum = 0.0;
        for (int x = k_pixels / 2 + 2; x < k_pixels; ++x) {
            const double difference = got.at(x, k_pixels / 2).x - want.at(x, k_pixels / 2).x;
            // Each of 16 places may fall to the other side of an edge.
            EXPECT_NEAR(difference / lit, 0.0, 1.5 / 16.0) << "pixel " << x;
            sum += difference / lit;
        }
        EXPECT_NEAR(sum / (0.5 * k_pixels), 0.0, k_mean) << static_cast<int>(type);
    }
}

TEST_F(SoftShadows, ABeamHasASharpEdgeAndNothingBehindItHidesIt) {
    // A spread of 2 degrees, tilted by 20: the half plane's shadow ends at k_edge_height tan 20 degrees,
    // within a penumbra of a centimetre. Of 64 places on 0.9 x 0.9 m a receiver sees one or none. A ceiling
    // hangs behind the light.
    scene::Light light = light_of(scene::LightType::area);
    light.size_x_m = light.size_y_m = 0.9F;
    light.spread_rad = static_cast<float>(2.0 * pi / 180.0);
    const double tilt = 20.0 * pi / 180.0;
    const glm::dmat4 place =
        glm::rotate(glm::translate(glm::dmat4(1.0),
                                   glm::dvec3(0.15 - k_light_height * std::tan(tilt), 0.0, k_light_height)),
                    -tilt, glm::dvec3(0.0, 1.0, 0.0));
    const auto drawn = [&](bool occluder, bool shadow) {
        light.cast_shadow = shadow;
        scene::Scene scene = scene_with(light, place, occluder);
        add_mesh_node(scene, add_square(scene, 6.0F, add_diffuse(scene)),
                      glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, k_light_height + 0.6)));
        return draw(scene, camera_from_above(k_width, 2.0), settings());
    };
    const Rendered lit = drawn(false, false);
    const Rendered open = drawn(false, true);
    const Rendered shaded = drawn(true, true);
    const double edge = k_edge_height * std::tan(tilt);
    for (int x = k_pixels / 2 + 2; x < k_pixels; ++x) {
        const double at = ((x + 0.5) / k_pixels - 0.5) * k_width;
        const double whole = lit.at(x, k_pixels / 2).x;
        ASSERT_GT(whole, 0.0) << at;
        EXPECT_EQ(open.at(x, k_pixels / 2).x, whole) << at;
        if (std::abs(at - edge) > 0.012) {
            // Pictures are of half floats.
            EXPECT_NEAR(shaded.at(x, k_pixels / 2).x / whole, at < edge ? 0.0 : 1.0, 2e-3) << at;
        }
    }
}

TEST_F(SoftShadows, AnImagesColoursAreInThePenumbra) {
    // The light's half towards -X is red, the other green: where the half plane hides one of them, the other
    // is left.
    scene::Light light = light_of(scene::LightType::area);
    light.shape = scene::AreaShape::rectangle;
    light.size_x_m = 0.9F;
    light.size_y_m = 0.5F;
    light.pattern = {2, 1, {{2.0F, 0.0F, 1.0F}, {0.0F, 2.0F, 1.0F}}};
    const CameraView camera = camera_from_above(k_width, 10.0);
    const Rendered lit = draw(scene_with(light, overhead(), false), camera, settings());
    const Rendered shaded = draw(scene_with(light, overhead(), true), camera, settings());
    double red_alone = 0.0;
    double green_alone = 0.0;
    for (int x = k_pixels / 2 + 2; x < k_pixels; ++x) {
        const glm::dvec3 part = shaded.at(x, k_pixels / 2) / lit.at(x, k_pixels / 2);
        red_alone = std::max(red_alone, part.r - part.g);
        green_alone = std::max(green_alone, part.g - part.r);
        const glm::dvec3 left = shaded.at(x, k_pixels / 2);
        // Each place sends as much blue as the mean of its red and green.
        EXPECT_NEAR(left.b, 0.5 * (left.r + left.g), 0.002 * lit.at(x, k_pixels / 2).b);
    }
    EXPECT_GT(std::max(red_alone, green_alone), 0.9)
        << "one half is seen whole where nothing is of the other";
    EXPECT_LT(std::min(red_alone, green_alone), 0.02);
}

TEST_F(SoftShadows, AHardLightIsDrawnAsWithoutThem) {
    for (const auto type : {scene::LightType::spot, scene::LightType::point, scene::LightType::sun}) {
        const scene::Light light = light_of(type);
        const CameraView camera = camera_from_above(k_width, 10.0);
        Settings hard = settings();
        hard.direct_shadows = DirectShadows::hard;
        const Rendered expected = draw(scene_with(light, overhead(), true), camera, hard);
        const Rendered got = draw(scene_with(light, overhead(), true), camera, settings());
        EXPECT_EQ(got.image.rgb, expected.image.rgb) << "type " << static_cast<int>(type);
        EXPECT_EQ(got.report.executed, expected.report.executed);
        EXPECT_THAT(got.report.executed, Not(Contains(HasSubstr("soft"))));
    }
}

TEST_F(SoftShadows, APenumbraTooNarrowToBeSeenIsDrawnAsAHardShadow) {
    scene::Light light = light_of(scene::LightType::sun);
    light.angle_rad = 1e-4F;  // over the scene's nine metres less than a millimetre; pixels are nine
    const CameraView camera = camera_from_above(k_width, 10.0);
    const Rendered got = draw(scene_with(light, overhead(), true), camera, settings());
    EXPECT_THAT(got.report.executed, Contains("shadow map: light"));
    EXPECT_THAT(got.report.executed, Not(Contains(HasSubstr("soft"))));
}

// Convolution shadow maps are an estimate: a lit surface must stay lit, an umbra dark, and the penumbra lie
// where it should.
class ConvolutionShadows : public SoftShadows {
  protected:
    static Settings convolved() {
        Settings s = settings();
        s.direct_shadows = DirectShadows::convolution;
        return s;
    }
};

TEST_F(ConvolutionShadows, AHalfPlaneHidesAboutItsPartOfALight) {
    for (const auto type :
         {scene::LightType::point, scene::LightType::spot, scene::LightType::sun, scene::LightType::area}) {
        scene::Light light = light_of(type);
        light.radius_m = 0.3F;
        light.angle_rad = static_cast<float>(12.0 * pi / 180.0);
        light.size_x_m = light.size_y_m = 0.6F;
        glm::dmat4 at = overhead();
        if (type == scene::LightType::sun) {
            at = glm::rotate(glm::dmat4(1.0), -0.4, glm::dvec3(0.0, 1.0, 0.0));
        }
        const CameraView camera = camera_from_above(k_width, 10.0);
        const Rendered got = draw(scene_with(light, at, true), camera, convolved());
        const Rendered want = draw(scene_with(light, at, true), camera, settings());
        const Rendered lit = draw(scene_with(light, at, false), camera, settings());
        EXPECT_THAT(got.report.executed, Contains("convolution sums: light"));
        EXPECT_THAT(got.report.executed, Not(Contains("soft shadow probe: light")));
        double sum = 0.0;
        for (int x = k_pixels / 2 + 2; x < k_pixels; ++x) {
            const double off =
                (got.at(x, k_pixels / 2).x - want.at(x, k_pixels / 2).x) / lit.at(x, k_pixels / 2).x;
            ASSERT_TRUE(std::isfinite(off));
            // Half of a penumbra is the most that a wrong width costs; a hard shadow's edge is off by as much
            // as 0.5.
            EXPECT_NEAR(off, 0.0, 0.35) << "type " << static_cast<int>(type) << ", pixel " << x;
            sum += off;
        }
        EXPECT_NEAR(sum / (0.5 * k_pixels), 0.0, 0.04) << static_cast<int>(type);
    }
}

TEST_F(ConvolutionShadows, ASurfaceHardlyShadowsItself) {
    for (const auto type :
         {scene::LightType::spot, scene::LightType::point, scene::LightType::sun, scene::LightType::area}) {
        for (const double degrees : {0.0, 40.0}) {
            scene::Light light = light_of(type);
            light.radius_m = 0.2F;
            light.angle_rad = 0.1F;
            light.size_x_m = light.size_y_m = 0.3F;
            const glm::dmat4 tilted =
                glm::rotate(glm::dmat4(1.0), degrees * pi / 180.0, glm::dvec3(0.0, 1.0, 0.0));
            const glm::dmat4 at = glm::translate(tilted, glm::dvec3(0.0, 0.0, 3.0));
            const CameraView camera = camera_from_above(4.0, 10.0);
            const Rendered got = draw(scene_with(light, at, false), camera, convolved());
            light.cast_shadow = false;
            const Rendered lit = draw(scene_with(light, at, false), camera, convolved());
            EXPECT_GT(lit.mean(), 0.0);
            // What the series rings on a slope that a filter sees cut off by its map's edge.
            EXPECT_NEAR(got.mean() / lit.mean(), 1.0, 0.01) << static_cast<int>(type) << " at " << degrees;
        }
    }
}

TEST_F(ConvolutionShadows, ALightWithoutSizeIsDrawnAsWithoutThem) {
    const scene::Light light = light_of(scene::LightType::spot);
    const CameraView camera = camera_from_above(k_width, 10.0);
    const Rendered expected = draw(scene_with(light, overhead(), true), camera, settings());
    const Rendered got = draw(scene_with(light, overhead(), true), camera, convolved());
    EXPECT_EQ(got.image.rgb, expected.image.rgb);
    EXPECT_EQ(got.report.executed, expected.report.executed);
}

// Imperfect shadow maps: texels of some two centimetres on this floor, and surfaces drawn from points. Each
// place's outline is off by up to a texel of its own map; over 256 places that are turned against each other
// this averages, and blurs the penumbra by about a texel of its 30 to 40 centimetres.
constexpr double k_worst_imperfect = 0.06;
constexpr double k_mean_imperfect = 0.015;

class ImperfectShadows : public SoftShadows {
  protected:
    static Settings imperfect() {
        Settings s = settings();
        s.direct_shadows = DirectShadows::ism;
        return s;
    }
    static scene::Light sized(scene::LightType type) {
        scene::Light light = light_of(type);
        light.radius_m = 0.3F;
        light.angle_rad = static_cast<float>(12.0 * pi / 180.0);
        light.shape = scene::AreaShape::rectangle;
        light.size_x_m = 0.9F;
        light.size_y_m = 0.5F;
        return light;
    }
};

TEST_F(ImperfectShadows, AHalfPlaneLeavesItsPartOfARectangle) {
    const scene::Light light = sized(scene::LightType::area);
    const CameraView camera = camera_from_above(k_width, 10.0);
    for (const int places : {256, 512}) {
        Settings s = imperfect();
        s.shadow_samples = places;
        const Rendered shaded = draw(scene_with(light, overhead(), true), camera, s);
        const Rendered lit = draw(scene_with(light, overhead(), false), camera, s);
        EXPECT_THAT(shaded.report.executed, Contains("ism triangles"));
        EXPECT_THAT(shaded.report.executed, Contains("soft shadow: light"));
        EXPECT_THAT(shaded.report.executed, Not(Contains("soft shadow maps: light")));
        expect_penumbra(shaded, lit, rectangle_beyond_edge, std::to_string(places) + " places",
                        k_worst_imperfect, k_mean_imperfect);
    }
}

TEST_F(ImperfectShadows, SoDoesOneOfPointsAlone) {
    // The half plane and the floor as points. Each of 8,192 over 52 square metres has a disk of 7 cm, by
    // about half of which the outline reaches too far; seen from the floor that is 30 cm at the light's
    // height, a third of the light, so that it darkens the penumbra by a third at most, and by half of that
    // in the mean. Squares of one depth need a bias besides, by which they leak.
    const scene::Light light = sized(scene::LightType::area);
    const CameraView camera = camera_from_above(k_width, 10.0);
    for (const Splat splat : {Splat::disks, Splat::compute, Splat::points}) {
        const std::string what = "splat " + std::to_string(static_cast<int>(splat));
        Settings s = imperfect();
        s.splat = splat;
        s.large_triangles = false;
        s.ism_points = 8192;
        s.shadow_samples = 32;
        s.soft_shadow_size = 64;
        const Rendered shaded = draw(scene_with(light, overhead(), true), camera, s);
        const Rendered lit = draw(scene_with(light, overhead(), false), camera, s);
        EXPECT_THAT(shaded.report.executed, Not(Contains("ism triangles")));
        EXPECT_EQ(shaded.report.shadow_points_a_map, 8192);
        double sum = 0.0;
        double worst = 0.0;
        for (int x = k_pixels / 2 + 2; x < k_pixels; ++x) {
            const double at = ((x + 0.5) / k_pixels - 0.5) * k_width;
            const double off =
                shaded.at(x, k_pixels / 2).x / lit.at(x, k_pixels / 2).x - rectangle_beyond_edge(at);
            worst = std::max(worst, std::abs(off));
            sum += off;
        }
        EXPECT_LT(worst, 0.45) << what;
        EXPECT_NEAR(sum / (0.5 * k_pixels), 0.0, 0.18) << what;
    }
}

TEST_F(ImperfectShadows, EveryKindOfLightHasThePenumbraOfItsMapsOfTriangles) {
    for (const auto type :
         {scene::LightType::point, scene::LightType::spot, scene::LightType::sun, scene::LightType::area}) {
        const scene::Light light = sized(type);
        glm::dmat4 at = overhead();
        if (type == scene::LightType::sun) {
            at = glm::rotate(glm::dmat4(1.0), -0.4, glm::dvec3(0.0, 1.0, 0.0));
        }
        const CameraView camera = camera_from_above(k_width, 10.0);
        const Rendered got = draw(scene_with(light, at, true), camera, imperfect());
        const Rendered want = draw(scene_with(light, at, true), camera, settings());
        const Rendered lit = draw(scene_with(light, at, false), camera, settings());
        double sum = 0.0;
        for (int x = k_pixels / 2 + 2; x < k_pixels; ++x) {
            const double off =
                (got.at(x, k_pixels / 2).x - want.at(x, k_pixels / 2).x) / lit.at(x, k_pixels / 2).x;
            EXPECT_NEAR(off, 0.0, k_worst_imperfect) << "type " << static_cast<int>(type) << ", pixel " << x;
            sum += off;
        }
        EXPECT_NEAR(sum / (0.5 * k_pixels), 0.0, k_mean_imperfect) << static_cast<int>(type);
    }
}

TEST_F(ImperfectShadows, NothingShadowsItself) {
    // As for maps of triangles: what is seen whole is the unshadowed light to the bit.
    for (const auto type :
         {scene::LightType::spot, scene::LightType::point, scene::LightType::sun, scene::LightType::area}) {
        for (const double degrees : {0.0, 40.0, 75.0}) {
            scene::Light light = sized(type);
            const glm::dmat4 tilted =
                glm::rotate(glm::dmat4(1.0), degrees * pi / 180.0, glm::dvec3(0.0, 1.0, 0.0));
            const glm::dmat4 at = glm::translate(tilted, glm::dvec3(0.0, 0.0, 3.0));
            const CameraView camera = camera_from_above(4.0, 10.0);
            for (const bool triangles : {true, false}) {
                // A point's normal has 8 bits: planes that orthographic maps see beyond 80 degrees, as from
                // the rim of this sun, lie up to their disks' radius off.
                if (!triangles && type == scene::LightType::sun && degrees > 60.0) {
                    continue;
                }
                Settings s = imperfect();
                s.large_triangles = triangles;
                s.shadow_samples = 32;
                light.cast_shadow = true;
                const Rendered with_shadow = draw(scene_with(light, at, false), camera, s);
                light.cast_shadow = false;
                const Rendered without = draw(scene_with(light, at, false), camera, s);
                EXPECT_GT(without.mean(), 0.0);
                EXPECT_EQ(with_shadow.image.rgb, without.image.rgb)
                    << "type " << static_cast<int>(type) << " at " << degrees << " degrees, "
                    << (triangles ? "triangles" : "points");
            }
        }
    }
}

TEST_F(ImperfectShadows, ALightAmongWhatItLightsHasTwoMapsAPlace) {
    // A point light between a floor and a wall that reaches above it: a half plane has the penumbra of maps
    // of triangles.
    const scene::Light light = sized(scene::LightType::point);
    const CameraView camera = camera_from_above(1.2, 10.0);
    scene::Scene scene = scene_with(light, overhead(), true);
    const glm::dmat4 upright = glm::rotate(glm::dmat4(1.0), 0.5 * pi, glm::dvec3(1.0, 0.0, 0.0));
    add_mesh_node(scene, add_square(scene, 5.0F, 0),
                  glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.59, 2.6)) * upright);
    const Rendered got = draw(scene, camera, imperfect());
    const Rendered want = draw(scene, camera, settings());
    const double lit = want.at(k_pixels - 1, k_pixels / 2).x;
    for (int x = k_pixels / 2 + 2; x < k_pixels; ++x) {
        // A whole hemisphere's texels are five centimetres wide on the floor.
        EXPECT_NEAR((got.at(x, k_pixels / 2).x - want.at(x, k_pixels / 2).x) / lit, 0.0, 0.1)
            << "pixel " << x;
    }
}

TEST_F(ImperfectShadows, AnEmptyRoomIsLitWhole) {
    // Walls on all sides of a light, as triangles and as points: nothing stands between, also not where a
    // place's two hemispheres meet.
    scene::Light light = sized(scene::LightType::point);
    CameraView camera;
    camera.world_from_camera = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, 1.4));
    camera.camera.perspective = true;
    camera.camera.yfov_rad = 2.0F;
    const auto room = [&] {
        scene::Scene scene;
        scene.from_blender = true;
        const int mesh = add_square(scene, 3.0F, add_diffuse(scene));
        for (int side = 0; side < 4; ++side) {
            const glm::dmat4 turned =
                glm::rotate(glm::dmat4(1.0), 0.5 * pi * side, glm::dvec3(0.0, 1.0, 0.0));
            add_mesh_node(scene, mesh, glm::translate(turned, glm::dvec3(0.0, 0.0, -1.5)));
        }
        for (const double turn : {-0.5 * pi, 0.5 * pi}) {
            const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), turn, glm::dvec3(1.0, 0.0, 0.0));
            add_mesh_node(scene, mesh, glm::translate(turned, glm::dvec3(0.0, 0.0, -1.5)));
        }
        add_light(scene, light, glm::translate(glm::dmat4(1.0), glm::dvec3(0.2, 0.1, 0.3)));
        return scene;
    };
    Settings s = imperfect();
    s.shadow_samples = 32;
    light.cast_shadow = false;
    const Rendered want = draw(room(), camera, s);
    light.cast_shadow = true;
    EXPECT_EQ(draw(room(), camera, s).image.rgb, want.image.rgb);
    s.large_triangles = false;
    EXPECT_NEAR(draw(room(), camera, s).mean() / want.mean(), 1.0, 0.002);
}

TEST_F(ImperfectShadows, WhatIsOnTheHullHidesALightOutsideOfIt) {
    // A roof over the whole scene: lines between two of its places do not cross it, but those to the light
    // do.
    const scene::Light light = sized(scene::LightType::area);
    scene::Scene scene = scene_with(light, overhead(), false);
    add_mesh_node(scene, add_square(scene, 6.0F, 0),
                  glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, k_edge_height)));
    CameraView below = camera_from_above(k_width, 0.5 * k_edge_height);
    for (const Technique technique : {Technique::direct, Technique::ism}) {
        Settings s = imperfect();
        s.technique = technique;
        s.shadow_samples = 16;
        const Rendered got = draw(scene, below, s);
        EXPECT_EQ(got.mean(), 0.0) << static_cast<int>(technique);
    }
}

TEST_F(ImperfectShadows, ALightWithoutSizeIsDrawnAsWithoutThem) {
    for (const auto type : {scene::LightType::spot, scene::LightType::point, scene::LightType::sun}) {
        const scene::Light light = light_of(type);
        const CameraView camera = camera_from_above(k_width, 10.0);
        const Rendered expected = draw(scene_with(light, overhead(), true), camera, settings());
        const Rendered got = draw(scene_with(light, overhead(), true), camera, imperfect());
        EXPECT_EQ(got.image.rgb, expected.image.rgb) << "type " << static_cast<int>(type);
        EXPECT_EQ(got.report.executed, expected.report.executed);
        EXPECT_EQ(got.report.points, 0U);
    }
}

}  // namespace
}  // namespace bounce::test
