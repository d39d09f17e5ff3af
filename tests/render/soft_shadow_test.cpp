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
    // The half plane and the floor as points: 8,192 of them over 52 square metres stand for 4.5 cm around
    // them each, and their disks reach 7 cm, a fifth of the penumbra. Squares of one depth need a bias as
    // well, and leak by it.
    const scene::Light light = sized(scene::LightType::area);
    const CameraView camera = camera_from_above(k_width, 10.0);
    for (const Splat splat : {Splat::disks, Splat::compute, Splat::points}) {
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
        for (int x = k_pixels / 2 + 2; x < k_pixels; ++x) {
            const double at = ((x + 0.5) / k_pixels - 0.5) * k_width;
            const double off =
                shaded.at(x, k_pixels / 2).x / lit.at(x, k_pixels / 2).x - rectangle_beyond_edge(at);
            EXPECT_NEAR(off, 0.0, splat == Splat::disks ? 0.2 : 0.4) << "splat " << static_cast<int>(splat);
            sum += off;
        }
        EXPECT_NEAR(sum / (0.5 * k_pixels), 0.0, splat == Splat::disks ? 0.08 : 0.2)
            << "splat " << static_cast<int>(splat);
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
    // A point light between a floor and walls that reach above it: what they show of it is unshadowed to the
    // bit, on either side of the border between a place's hemispheres; and a half plane has the penumbra of
    // maps of triangles.
    const scene::Light light = sized(scene::LightType::point);
    const CameraView camera = camera_from_above(1.2, 10.0);
    const auto with_walls = [&](const scene::Light& of, bool occluder) {
        scene::Scene scene = scene_with(of, overhead(), occluder);
        const glm::dmat4 upright = glm::rotate(glm::dmat4(1.0), 0.5 * pi, glm::dvec3(1.0, 0.0, 0.0));
        const glm::dmat4 leaning = glm::rotate(glm::dmat4(1.0), 0.3 * pi, glm::dvec3(1.0, 0.0, 0.0));
        add_mesh_node(scene, add_square(scene, 5.0F, 0),
                      glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.59, 2.6)) * upright);
        add_mesh_node(scene, add_square(scene, 6.0F, 0),
                      glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, -2.6, 2.9)) * leaning);
        return scene;
    };
    scene::Light unshadowed = light;
    unshadowed.cast_shadow = false;
    EXPECT_EQ(draw(with_walls(light, false), camera, imperfect()).image.rgb,
              draw(with_walls(unshadowed, false), camera, imperfect()).image.rgb);
    const Rendered got = draw(with_walls(light, true), camera, imperfect());
    const Rendered want = draw(with_walls(light, true), camera, settings());
    const double lit = want.at(k_pixels - 1, k_pixels / 2).x;
    for (int x = k_pixels / 2 + 2; x < k_pixels; ++x) {
        // A whole hemisphere's texels are five centimetres wide on the floor.
        EXPECT_NEAR((got.at(x, k_pixels / 2).x - want.at(x, k_pixels / 2).x) / lit, 0.0, 0.1)
            << "pixel " << x;
    }
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
