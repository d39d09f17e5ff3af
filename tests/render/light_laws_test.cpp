// SPDX-License-Identifier: Apache-2.0
//
// Each light over a white Lambertian plane, against the laws and the values measured in Cycles
// (docs/lights.md). Tolerance 0.5 % of the value: what a look-dev artist cannot see, and five times what the
// sampling of a pixel's area costs here.
#include <algorithm>

#include "render_fixture.h"

namespace bounce::test {
namespace {

constexpr double k_tolerance = 0.005;
constexpr int k_size = 65;  // odd: the middle pixel is under the light

Settings direct_settings() {
    Settings settings;
    settings.width = k_size;
    settings.height = k_size;
    settings.technique = Technique::direct;
    return settings;
}

// A light at `height` above the plane, looking down; scale multiplies every length.
Rendered plane_under(const scene::Light& light, double height, double frame_width, double scale = 1.0,
                     const glm::dvec3& origin = glm::dvec3(0.0)) {
    scene::Scene scene;
    scene.from_blender = true;
    const int square = add_square(scene, static_cast<float>(200.0 * scale), add_diffuse(scene));
    const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), origin);
    add_mesh_node(scene, square, moved);
    add_light(scene, light, glm::translate(moved, glm::dvec3(0.0, 0.0, height * scale)));
    CameraView camera = camera_from_above(frame_width, 50.0, scale);
    camera.world_from_camera = moved * camera.world_from_camera;
    return draw(scene, camera, direct_settings());
}

void expect_close(double got, double expected, const std::string& what) {
    EXPECT_NEAR(got / expected, 1.0, k_tolerance) << what << ": got " << got << ", law " << expected;
}

class LightLaws : public ::testing::Test {
  protected:
    void SetUp() override { require_context(); }
};

TEST_F(LightLaws, Point) {
    scene::Light light;
    light.power_w = 100.0F;
    const Rendered r = plane_under(light, 3.0, 6.5);
    const int middle = k_size / 2;
    for (const int dx : {0, 10, 20, 30}) {
        const double x = dx * 6.5 / k_size;
        const double d2 = x * x + 9.0;
        const double cosine = 3.0 / std::sqrt(d2);
        expect_close(r.at(middle + dx, middle).x, 100.0 / (4.0 * pi) * cosine / (pi * d2),
                     "point at x = " + std::to_string(x));
    }
}

TEST_F(LightLaws, PointWithRadius) {
    scene::Light light;
    light.power_w = 100.0F;
    light.radius_m = 0.5F;
    const Rendered r = plane_under(light, 3.0, 0.65);
    // Measured in Cycles: 0.973 of the point.
    expect_close(r.at(k_size / 2, k_size / 2).x, 0.973 * 100.0 / (4.0 * pi) / (pi * 9.0),
                 "radius 0.5 at 3 m");
}

// Radiance of a white floor at the origin under a disk of radius r at (2, 0, z) that faces it: sum over the
// disk.
double disk_sum(double power_w, double r, double z) {
    constexpr int side = 400;
    const glm::dvec3 middle(2.0, 0.0, z);
    const glm::dvec3 axis = glm::normalize(middle);
    const glm::dvec3 across(0.0, 1.0, 0.0);
    const glm::dvec3 up = glm::cross(axis, across);
    double sum = 0.0;
    int pieces = 0;
    for (int i = 0; i < side * side; ++i) {
        const glm::dvec2 u((i % side + 0.5) / side * 2.0 - 1.0, (i / side + 0.5) / side * 2.0 - 1.0);
        if (glm::length(u) > 1.0) {
            continue;
        }
        ++pieces;
        const glm::dvec3 d = middle + r * (u.x * across + u.y * up);
        const double distance = glm::length(d);
        sum += std::max(d.z, 0.0) / distance * (glm::dot(d, axis) / distance) / (distance * distance);
    }
    return power_w / (4.0 * pi) * sum / pieces / pi;
}

TEST_F(LightLaws, ALightWithARadiusShinesOverTheHorizon) {
    // Half angle 14 degrees; from half of it under the floor to all of it above. 1 % of the last: the disk's
    // distance is taken for the same all over it.
    const double brightest = disk_sum(100.0, 0.5, 0.6);
    for (const double z : {-0.6, -0.3, 0.0, 0.3, 0.6}) {
        scene::Light light;
        light.power_w = 100.0F;
        light.radius_m = 0.5F;
        light.cast_shadow = false;
        scene::Scene scene;
        scene.from_blender = true;
        add_mesh_node(scene, add_square(scene, 200.0F, add_diffuse(scene)), glm::dmat4(1.0));
        add_light(scene, light, glm::translate(glm::dmat4(1.0), glm::dvec3(2.0, 0.0, z)));
        const Rendered r = draw(scene, camera_from_above(0.01, 50.0), direct_settings());
        EXPECT_NEAR(r.at(k_size / 2, k_size / 2).x / brightest, disk_sum(100.0, 0.5, z) / brightest, 0.01)
            << z;
    }
}

TEST_F(LightLaws, ASpotWithALargeRadiusCountsItsPartsByWhatTheySend) {
    // A disk that faces the floor below it, up to half again as wide as it is high. Its rim looks down
    // aslant, with less of the cone's profile, and counts less. 2 %: 64 places on it.
    constexpr double height = 2.0;
    constexpr double half_cone = 0.7;
    for (const double radius : {0.5, 1.5, 3.0}) {
        scene::Light light;
        light.type = scene::LightType::spot;
        light.power_w = 100.0F;
        light.radius_m = static_cast<float>(radius);
        light.cone_angle_rad = static_cast<float>(2.0 * half_cone);
        light.blend = 0.5F;
        light.cast_shadow = false;
        double sum = 0.0;
        constexpr int rings = 2000;
        for (int i = 0; i < rings; ++i) {
            const double out = radius * std::sqrt((i + 0.5) / rings);  // of even area
            const double cosine = height / std::hypot(height, out);
            const double t =
                std::clamp((cosine - std::cos(half_cone)) / ((1.0 - std::cos(half_cone)) * 0.5), 0.0, 1.0);
            sum += cosine * t * t * (3.0 - 2.0 * t) * std::pow(cosine, 4.0) / (height * height) / rings;
        }
        const Rendered r = plane_under(light, height, 0.01);
        EXPECT_NEAR(r.at(k_size / 2, k_size / 2).x / (100.0 / (4.0 * pi) * sum / pi), 1.0, 0.02) << radius;
    }
}

TEST_F(LightLaws, Sun) {
    scene::Light light;
    light.type = scene::LightType::sun;
    light.irradiance_w_m2 = 2.0F;
    const Rendered r = plane_under(light, 3.0, 10.0);
    expect_close(r.at(k_size / 2, k_size / 2).x, 2.0 / pi, "sun");
    expect_close(r.at(3, 60).x, 2.0 / pi, "sun, corner");
}

TEST_F(LightLaws, AWideSunIsItsDirectionsMeanCosine) {
    // Even over the disk of radius tan(angle / 2) at distance 1; none at 180 degrees, as in Cycles.
    scene::Light light;
    light.type = scene::LightType::sun;
    light.irradiance_w_m2 = 2.0F;
    for (const double degrees : {10.0, 90.0}) {
        light.angle_rad = static_cast<float>(degrees * pi / 180.0);
        constexpr int rings = 100000;
        const double radius = std::tan(0.5 * degrees * pi / 180.0);
        double sum = 0.0;
        for (int i = 0; i < rings; ++i) {
            sum += 1.0 / std::sqrt(1.0 + radius * radius * (i + 0.5) / rings);
        }
        const Rendered r = plane_under(light, 3.0, 10.0);
        expect_close(r.at(k_size / 2, k_size / 2).x, 2.0 / pi * sum / rings,
                     "sun of " + std::to_string(degrees));
    }
    light.angle_rad = static_cast<float>(pi);
    EXPECT_NEAR(plane_under(light, 3.0, 10.0).at(k_size / 2, k_size / 2).x, 0.0, 1e-6);
}

TEST_F(LightLaws, PowerBelowZeroTakesAsMuchAway) {
    for (const auto type : {scene::LightType::point, scene::LightType::sun, scene::LightType::area}) {
        scene::Light light;
        light.type = type;
        light.power_w = 100.0F;
        light.irradiance_w_m2 = 2.0F;
        light.size_x_m = light.size_y_m = 0.5F;
        const Rendered given = plane_under(light, 3.0, 6.5);
        light.power_w *= -1.0F;
        light.irradiance_w_m2 *= -1.0F;
        const Rendered taken = plane_under(light, 3.0, 6.5);
        EXPECT_GT(given.at(10, 20).x, 0.0);
        EXPECT_EQ(taken.at(10, 20).x, -given.at(10, 20).x) << static_cast<int>(type);
    }
}

// A spot with a radius: the cone's profile, averaged over the disk that faces the place x from under its
// middle.
double rim_mean(double half_angle, double blend, double radius, double height, double x) {
    constexpr int side = 400;
    const glm::dvec3 middle(-x, 0.0, height);
    const glm::dvec3 to_light = glm::normalize(middle);
    const glm::dvec3 across(0.0, 1.0, 0.0);
    const glm::dvec3 up = glm::cross(to_light, across);
    double sum = 0.0;
    int pieces = 0;
    for (int i = 0; i < side * side; ++i) {
        const glm::dvec2 u(2.0 * (i % side + 0.5) / side - 1.0, 2.0 * (i / side + 0.5) / side - 1.0);
        if (glm::dot(u, u) > 1.0) continue;
        const double cosine = glm::normalize(middle + radius * (u.x * across + u.y * up)).z;
        const double edge = std::cos(half_angle);
        const double t = std::clamp((cosine - edge) / ((1.0 - edge) * blend), 0.0, 1.0);
        sum += cosine * t * t * (3.0 - 2.0 * t);
        ++pieces;
    }
    return sum / pieces;
}

TEST_F(LightLaws, ARadiusSoftensASpotsRim) {
    scene::Light light;
    light.type = scene::LightType::spot;
    light.power_w = 100.0F;
    light.radius_m = 0.35F;
    light.cone_angle_rad = static_cast<float>(30.0 * pi / 180.0);
    light.blend = 0.1F;
    const double frame_width = 4.0;
    const Rendered r = plane_under(light, 3.0, frame_width);
    const double on_axis = r.at(k_size / 2, k_size / 2).x;
    double worst = 0.0;
    for (int dx = 0; dx <= 25; ++dx) {
        const double x = dx * frame_width / k_size;
        const double d2 = x * x + 9.0;
        const double falloff = 3.0 / std::sqrt(d2) * (9.0 + 0.1225) / (d2 + 0.1225);
        const double law = falloff * rim_mean(15.0 * pi / 180.0, 0.1, 0.35, 3.0, x) /
                           rim_mean(15.0 * pi / 180.0, 0.1, 0.35, 3.0, 0.0);
        const double off = r.at(k_size / 2 + dx, k_size / 2).x / on_axis - law;
        worst = std::max(worst, std::abs(off));
        // A rim as hard as this one crosses two places of 64 at a time; the middle of the cone is as exact as
        // elsewhere.
        EXPECT_NEAR(off, 0.0, x < 0.3 ? k_tolerance : 2.0 / 64.0) << "x = " << x;
    }
    // Without the radius the rim is 0.13 wide instead of 0.8, and the error at its middle one half.
    EXPECT_LT(worst, 0.1);
}

struct SpotProfileCase {
    double blend;
    std::vector<std::pair<double, double>> measured;  // degrees, intensity relative to the axis
};

TEST_F(LightLaws, SpotProfilesMeasuredInCycles) {
    const std::vector<SpotProfileCase> cases = {
        {0.0,
         {{5, .99619},
          {10, .98481},
          {15, .96593},
          {20, .93969},
          {24, .91355},
          {26, .89880},
          {28, .88295},
          {29, .87462},
          {29.5, .87036}}},
        {0.15,
         {{5, .99619},
          {10, .98481},
          {15, .96593},
          {20, .93969},
          {24, .91355},
          {26, .8988},
          {28, .82384},
          {29, .34308},
          {29.5, .10383}}},
        {0.5,
         {{5, .99619},
          {10, .98481},
          {15, .96593},
          {20, .93969},
          {24, .72693},
          {26, .43481},
          {28, .14057},
          {29, .03983},
          {29.5, .01095}}},
        {1.0,
         {{5, .99383},
          {10, .94969},
          {15, .81027},
          {20, .53989},
          {24, .26327},
          {26, .13501},
          {28, .03871},
          {29, .01079},
          {29.5, .00253}}},
    };
    constexpr double height = 3.0;
    for (const SpotProfileCase& test : cases) {
        scene::Light light;
        light.type = scene::LightType::spot;
        light.power_w = 100.0F;
        light.cone_angle_rad = static_cast<float>(60.0 * pi / 180.0);
        light.blend = static_cast<float>(test.blend);
        const double axis = 100.0 / (4.0 * pi) / (pi * height * height);
        expect_close(plane_under(light, height, 0.1).at(k_size / 2, k_size / 2).x, axis, "spot on axis");
        for (const auto& [degrees, profile] : test.measured) {
            // A frame so narrow that a pixel is a point, its middle at the angle.
            const double angle = degrees * pi / 180.0;
            const double x = height * std::tan(angle);
            const glm::dvec3 there(-x, 0.0, 0.0);  // the scene is moved under the camera
            scene::Scene scene;
            scene.from_blender = true;
            const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), there);
            add_mesh_node(scene, add_square(scene, 200.0F, add_diffuse(scene)), glm::dmat4(1.0));
            add_light(scene, light, glm::translate(moved, glm::dvec3(0.0, 0.0, height)));
            const Rendered r = draw(scene, camera_from_above(0.004, 50.0), direct_settings());
            // The table has distance and the receiver's cosine divided out.
            const double cosine = std::cos(angle);
            const double expected = axis * profile * cosine * cosine * cosine;
            // Where a blend has almost ended, Cycles' own values scatter with the size of the frame they are
            // measured in by up to 1e-3 of the axis (tests/cycles/measure_lights.py at 0.4 mm and 4 cm:
            // .01010 and .01116 at 29.5 degrees, blend 0.5); the law lies between them.
            const double scatter = 6e-4 / profile;
            EXPECT_NEAR(r.at(k_size / 2, k_size / 2).x / expected, 1.0, k_tolerance + scatter)
                << "blend " << test.blend << " at " << degrees << " degrees";
            const double t =
                test.blend > 0.0
                    ? std::clamp((cosine - std::cos(pi / 6.0)) / ((1.0 - std::cos(pi / 6.0)) * test.blend),
                                 0.0, 1.0)
                    : 1.0;
            const double law = axis * cosine * t * t * (3.0 - 2.0 * t) * cosine * cosine * cosine;
            expect_close(r.at(k_size / 2, k_size / 2).x, law, "law at " + std::to_string(degrees));
        }
        scene::Light beyond = light;
        const Rendered r = plane_under(beyond, height, 4.2);
        const int outside =
            k_size / 2 + static_cast<int>(height * std::tan(31.0 * pi / 180.0) / 4.2 * k_size) + 1;
        EXPECT_EQ(r.at(outside, k_size / 2).x, 0.0) << "nothing beyond the cone";
    }
}

TEST_F(LightLaws, WideSpotUsesACubeAndTheSameLaw) {
    scene::Light light;
    light.type = scene::LightType::spot;
    light.power_w = 100.0F;
    light.cone_angle_rad = static_cast<float>(170.0 * pi / 180.0);
    const Rendered r = plane_under(light, 3.0, 6.5);
    const double x = 20 * 6.5 / k_size;
    const double d2 = x * x + 9.0;
    const double cosine = 3.0 / std::sqrt(d2);
    expect_close(r.at(k_size / 2 + 20, k_size / 2).x, 100.0 / (4.0 * pi) * cosine * cosine / (pi * d2),
                 "170 degree spot");
}

TEST_F(LightLaws, AreaLightsOnAxisAndFar) {
    for (const scene::AreaShape shape : {scene::AreaShape::square, scene::AreaShape::rectangle,
                                         scene::AreaShape::disk, scene::AreaShape::ellipse}) {
        scene::Light light;
        light.type = scene::LightType::area;
        light.power_w = 100.0F;
        light.shape = shape;
        light.size_x_m = 0.05F;
        light.size_y_m =
            shape == scene::AreaShape::rectangle || shape == scene::AreaShape::ellipse ? 0.1F : 0.05F;
        expect_close(plane_under(light, 10.0, 0.5).at(k_size / 2, k_size / 2).x, 100.0 / (4.0 * pi * 100.0),
                     "area shape " + std::to_string(static_cast<int>(shape)));
    }
}

TEST_F(LightLaws, AreaSpreadProfileMeasuredInCycles) {
    // Values relative to an unspread light's cosine law. 2.5 %: they were measured with a light of finite
    // size and are noisy (on the axis 10.63 and, with a smaller light, 10.72, where the law has 10.74; at 50
    // degrees .771 and .783 against .789).
    const std::vector<std::pair<double, std::vector<std::pair<double, double>>>> cases = {
        {120.0, {{0, 2.509}, {10, 2.255}, {20, 1.982}, {30, 1.668}, {40, 1.284}, {50, .771}}},
        {60.0, {{0, 10.63}, {10, 7.41}, {20, 3.94}}},
    };
    for (const auto& [spread, values] : cases) {
        for (const auto& [degrees, relative] : values) {
            scene::Light light;
            light.type = scene::LightType::area;
            light.power_w = 100.0F;
            light.size_x_m = light.size_y_m = 0.05F;
            light.spread_rad = static_cast<float>(spread * pi / 180.0);
            const double x = 10.0 * std::tan(degrees * pi / 180.0);
            scene::Scene scene;
            scene.from_blender = true;
            add_mesh_node(scene, add_square(scene, 200.0F, add_diffuse(scene)), glm::dmat4(1.0));
            add_light(scene, light, glm::translate(glm::dmat4(1.0), glm::dvec3(-x, 0.0, 10.0)));
            const Rendered r = draw(scene, camera_from_above(0.01, 50.0), direct_settings());
            const double cosine = std::cos(degrees * pi / 180.0);
            const double expected = relative * 100.0 / (4.0 * pi * 100.0) * std::pow(cosine, 4.0);
            EXPECT_NEAR(r.at(k_size / 2, k_size / 2).x / expected, 1.0, 0.025) << spread << " at " << degrees;
        }
    }
}

// Radiance of a white floor at (x, 0, 0) under an area light of the unit box or disk times its sizes, by a
// sum over 400 x 400 pieces of it: good to 1e-3 at a tenth of its width.
double area_sum(const scene::Light& light, const glm::dmat4& world_from_light, double x) {
    constexpr int side = 400;
    const bool round = light.shape == scene::AreaShape::disk || light.shape == scene::AreaShape::ellipse;
    const double width = static_cast<double>(light.size_x_m);
    const double height = static_cast<double>(light.size_y_m);
    const glm::dvec3 axis = -glm::dvec3(world_from_light[2]);
    const double slats = std::tan(0.5 * (pi - static_cast<double>(light.spread_rad)));
    const double a = std::atan(slats);
    const double norm = slats > 1e-6 ? 2.0 / (2.0 + (2.0 * a - pi) * slats) : 1.0;
    double sum = 0.0;
    int pieces = 0;
    for (int i = 0; i < side * side; ++i) {
        const glm::dvec2 u((i % side + 0.5) / side - 0.5, (i / side + 0.5) / side - 0.5);
        if (round && glm::length(u) > 0.5) {
            continue;
        }
        ++pieces;
        const glm::dvec3 d = glm::dvec3(world_from_light * glm::dvec4(u.x * width, u.y * height, 0.0, 1.0)) -
                             glm::dvec3(x, 0.0, 0.0);
        const double squared = glm::dot(d, d);
        const double out = -glm::dot(d, axis) / std::sqrt(squared);
        const double across = std::sqrt(std::max(1.0 - out * out, 0.0));
        const double sent = out > 0.0 ? std::max(out - across * slats, 0.0) * norm : 0.0;
        sum += sent * std::max(d.z, 0.0) / std::sqrt(squared) / squared;
    }
    return static_cast<double>(light.power_w) / 4.0 * sum / pieces / pi;
}

TEST_F(LightLaws, AreaLightsNearTheirOwnWidth) {
    struct Case {
        scene::AreaShape shape;
        double height;
        double tilt;
        double spread_deg;
        double tolerance;
    };
    // A closed form but for the spread, whose grid has 8 x 8 points in what reaches the receiver: one
    // percent. A disk is a polygon of sixteen corners.
    const std::vector<Case> cases = {
        {scene::AreaShape::rectangle, 0.1, 0.0, 180.0, k_tolerance},
        {scene::AreaShape::rectangle, 0.6, 1.2, 180.0, k_tolerance},
        {scene::AreaShape::rectangle, 0.2, 1.5, 180.0, k_tolerance},  // half of it under the floor
        {scene::AreaShape::ellipse, 0.1, 0.0, 180.0, k_tolerance},
        {scene::AreaShape::ellipse, 0.6, 1.2, 180.0, k_tolerance},
        {scene::AreaShape::rectangle, 0.1, 0.0, 90.0, 0.01},
        {scene::AreaShape::rectangle, 0.5, 0.3, 60.0, 0.01},
    };
    for (const Case& c : cases) {
        scene::Light light;
        light.type = scene::LightType::area;
        light.power_w = 100.0F;
        light.shape = c.shape;
        light.size_x_m = 1.0F;
        light.size_y_m = 0.6F;
        light.spread_rad = static_cast<float>(c.spread_deg * pi / 180.0);
        const glm::dmat4 at = glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, c.height)),
                                          c.tilt, glm::dvec3(0.0, 1.0, 0.0));
        scene::Scene scene;
        scene.from_blender = true;
        add_mesh_node(scene, add_square(scene, 200.0F, add_diffuse(scene)), glm::dmat4(1.0));
        add_light(scene, light, at);
        scene.lights[0].cast_shadow = false;
        const Rendered r = draw(scene, camera_from_above(1.3, 50.0), direct_settings());
        double brightest = 0.0;
        for (int x = 2; x < k_size; x += 4) {
            brightest = std::max(brightest, area_sum(light, at, ((x + 0.5) / k_size - 0.5) * 1.3));
        }
        for (int x = 2; x < k_size; x += 4) {
            const double want = area_sum(light, at, ((x + 0.5) / k_size - 0.5) * 1.3);
            EXPECT_NEAR(r.at(x, k_size / 2).x / brightest, want / brightest, c.tolerance)
                << "shape " << static_cast<int>(c.shape) << ", height " << c.height << ", tilt " << c.tilt
                << ", spread " << c.spread_deg << ", pixel " << x;
        }
    }
}

// GGX of a white metal times the cosine, seen from straight above (docs/lights.md, Materials).
double white_metal(double roughness, const glm::dvec3& l) {
    if (l.z <= 0.0) {
        return 0.0;
    }
    const double alpha2 = std::pow(roughness, 4.0);
    const double n_dot_h = glm::normalize(l + glm::dvec3(0.0, 0.0, 1.0)).z;
    const double t = n_dot_h * n_dot_h * (alpha2 - 1.0) + 1.0;
    const double smith = l.z + std::sqrt(l.z * l.z * (1.0 - alpha2) + alpha2);
    return alpha2 / (pi * t * t) * l.z / (smith * 2.0);
}

// The same at (x, 0, 0), of a light above the origin at `height`: a mean over even pieces. A point's disk
// faces the receiver; a sun's is that of its directions at distance 1, with `height` 1 and the radius of its
// half angle's tangent.
double white_metal_under(const scene::Light& light, double roughness, double height, double x) {
    constexpr int side = 300;
    double sum = 0.0;
    for (int i = 0; i < side * side; ++i) {
        const double u = (i % side + 0.5) / side;
        const double v = (i / side + 0.5) / side;
        const glm::dvec2 disk = std::sqrt(u) * glm::dvec2(std::cos(2.0 * pi * v), std::sin(2.0 * pi * v));
        if (light.type == scene::LightType::sun) {
            const double radius = std::tan(0.5 * static_cast<double>(light.angle_rad));
            const glm::dvec3 axis = glm::normalize(glm::dvec3(-x, 0.0, height));
            const glm::dvec3 across(axis.z, 0.0, -axis.x);
            const glm::dvec3 d = axis + radius * (disk.x * across + disk.y * glm::dvec3(0.0, 1.0, 0.0));
            sum += static_cast<double>(light.irradiance_w_m2) * white_metal(roughness, glm::normalize(d));
        } else if (light.type == scene::LightType::point) {
            const glm::dvec3 middle(-x, 0.0, height);
            const glm::dvec3 axis = glm::normalize(middle);
            const glm::dvec3 across(axis.z, 0.0, -axis.x);
            const glm::dvec3 d = middle + static_cast<double>(light.radius_m) *
                                              (disk.x * across + disk.y * glm::dvec3(0.0, 1.0, 0.0));
            const glm::dvec3 l = glm::normalize(d);
            sum += static_cast<double>(light.power_w) / (4.0 * pi) * white_metal(roughness, l) *
                   glm::dot(l, axis) / glm::dot(d, d);
        } else {
            const glm::dvec3 d((u - 0.5) * static_cast<double>(light.size_x_m) - x,
                               (v - 0.5) * static_cast<double>(light.size_y_m), height);
            const glm::dvec3 l = glm::normalize(d);
            sum +=
                static_cast<double>(light.power_w) / 4.0 * white_metal(roughness, l) * l.z / glm::dot(d, d);
        }
    }
    return sum / (side * side);
}

TEST_F(LightLaws, GlossyLobesReflectALightsSize) {
    scene::Light point;
    point.power_w = 100.0F;
    point.radius_m = 0.5F;
    scene::Light area;
    area.type = scene::LightType::area;
    area.power_w = 100.0F;
    area.shape = scene::AreaShape::rectangle;
    area.size_x_m = 1.0F;
    area.size_y_m = 0.4F;
    scene::Light sun;
    sun.type = scene::LightType::sun;
    sun.irradiance_w_m2 = 2.0F;
    sun.angle_rad = static_cast<float>(20.0 * pi / 180.0);
    for (const scene::Light& given : {point, area, sun}) {
        for (const double roughness : {0.2, 0.4, 0.8}) {
            scene::Light light = given;
            light.cast_shadow = false;
            const bool is_sun = light.type == scene::LightType::sun;
            const double height = is_sun ? 1.0 : 2.0;
            double worst = 0.0;
            double brightest = 0.0;
            for (const double x : {0.0, 0.2, 0.5, 1.0, 2.0}) {
                scene::Scene scene;
                scene.from_blender = true;
                const int metal = add_diffuse(scene);
                scene.materials[static_cast<size_t>(metal)].metallic = 1.0F;
                scene.materials[static_cast<size_t>(metal)].specular = 0.5F;
                scene.materials[static_cast<size_t>(metal)].roughness = static_cast<float>(roughness);
                add_mesh_node(scene, add_square(scene, 200.0F, metal), glm::dmat4(1.0));
                const glm::dmat4 turned =
                    is_sun ? glm::rotate(glm::dmat4(1.0), -std::atan(x / height), glm::dvec3(0.0, 1.0, 0.0))
                           : glm::translate(glm::dmat4(1.0), glm::dvec3(-x, 0.0, height));
                add_light(scene, light, turned);
                const Rendered r = draw(scene, camera_from_above(0.01, 50.0), direct_settings());
                const double want = white_metal_under(light, roughness, height, x);
                brightest = std::max(brightest, want);
                worst = std::max(worst, std::abs(r.at(k_size / 2, k_size / 2).x - want));
            }
            // What the fit has wrong (tests/shaders/lobe_test.cpp), and a sun's radiance that grows towards
            // its rim. As points these lights' middles are up to 13 times as bright at roughness 0.2.
            EXPECT_LT(worst / brightest, 0.03) << static_cast<int>(light.type) << ", roughness " << roughness;
        }
    }
}

TEST_F(LightLaws, ScaleMovesAndPowersChangeNothingElse) {
    scene::Light light;
    light.power_w = 100.0F;
    const Rendered base = plane_under(light, 3.0, 6.5);
    const int middle = k_size / 2;
    for (const double scale : {1e-3, 1e3, 1e5}) {
        scene::Light scaled = light;
        scaled.power_w = static_cast<float>(100.0 * scale * scale);
        const Rendered r = plane_under(scaled, 3.0, 6.5, scale);
        EXPECT_NEAR(r.at(middle + 20, middle).x / base.at(middle + 20, middle).x, 1.0, 1e-3)
            << "scale " << scale;
    }
    const Rendered moved = plane_under(light, 3.0, 6.5, 1.0, {1e6, -1e6, 1e6});
    EXPECT_NEAR(moved.at(middle + 20, middle).x / base.at(middle + 20, middle).x, 1.0, 1e-3)
        << "a million metres away";
    for (const float factor : {1e-6F, 1e6F}) {
        scene::Light strong = light;
        strong.power_w *= factor;
        EXPECT_NEAR(plane_under(strong, 3.0, 6.5).at(middle, middle).x / base.at(middle, middle).x / factor,
                    1.0, 1e-5);
    }
}

TEST_F(LightLaws, DisneyDiffuseMeasuredInCycles) {
    // Factor over Lambert, seen from straight above, sun at an angle.
    const std::vector<std::tuple<float, double, double>> values = {
        {0.0F, 0, 1.0},    {0.0F, 60, 0.984}, {0.0F, 80, 0.807}, {0.5F, 60, 1.008}, {0.5F, 80, 1.034},
        {0.9F, 60, 1.027}, {0.9F, 80, 1.214}, {1.0F, 60, 1.031}, {1.0F, 80, 1.260}};
    for (const auto& [roughness, degrees, factor] : values) {
        scene::Scene scene;
        scene.from_blender = true;
        const int material = add_diffuse(scene);
        scene.materials[static_cast<size_t>(material)].diffuse = scene::DiffuseModel::disney;
        scene.materials[static_cast<size_t>(material)].roughness = roughness;
        add_mesh_node(scene, add_square(scene, 20.0F, material), glm::dmat4(1.0));
        scene::Light sun;
        sun.type = scene::LightType::sun;
        sun.irradiance_w_m2 = 1.0F;
        const double angle = degrees * pi / 180.0;
        add_light(scene, sun, glm::rotate(glm::dmat4(1.0), angle, glm::dvec3(0.0, 1.0, 0.0)));
        const Rendered r = draw(scene, camera_from_above(1.0, 50.0), direct_settings());
        EXPECT_NEAR(r.at(k_size / 2, k_size / 2).x / (std::cos(angle) / pi), factor, 0.005)
            << roughness << ", " << degrees;
    }
}

TEST_F(LightLaws, WorldOfRadianceOneIsWhite) {
    scene::Scene scene;
    scene.world = {glm::vec3(0.5F), 2.0F};
    add_mesh_node(scene, add_square(scene, 20.0F, add_diffuse(scene)), glm::dmat4(1.0));
    Settings settings = direct_settings();
    Rendered r = draw(scene, camera_from_above(40.0, 50.0), settings);
    EXPECT_NEAR(r.at(k_size / 2, k_size / 2).x, 1.0, 1e-2) << "on the plane, from 256 directions";
    EXPECT_NEAR(r.at(1, 1).x, 1.0, 1e-6) << "behind it";
    settings.world_vpls = 0;
    r = draw(scene, camera_from_above(40.0, 50.0), settings);
    EXPECT_NEAR(r.at(k_size / 2, k_size / 2).x, 1.0, 1e-3) << "on the plane, unoccluded";
}

}  // namespace
}  // namespace bounce::test
