// SPDX-License-Identifier: Apache-2.0
//
// Materials at and beyond the ends of what they may be.
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "stress/stress.h"

namespace bounce::stress {
namespace {

using nlohmann::json;

constexpr double pi = std::numbers::pi;

void add_sun(SceneFile& file) {
    file.light({{"type", "sun"}, {"irradiance_w_m2", pi}, {"angle_rad", 0}},
               looking({0.0, 0.0, 0.0}, {0.0, -1.0, 0.0}));
}

// A Lambertian ground under a sun of irradiance pi: its radiance is its albedo.
SceneFile sunlit(const glm::vec3& color) {
    SceneFile file;
    file.place(ground(4.0F), file.material(color));
    add_sun(file);
    file.camera_above(2.0, 3.0, 1.5);
    return file;
}

json roughness(double value, double metallic) {
    return {{"pbrMetallicRoughness", {{"roughnessFactor", value}, {"metallicFactor", metallic}}},
            {"extensions", {{"BOUNCE_scene", {{"specular", 0.5}}}}}};
}

Verdict smooth_mirror(StressRun& run) {
    SceneFile file;
    file.place(ground(4.0F), file.material(glm::vec3(0.8F), roughness(0.0, 1.0)));
    file.world(glm::vec3(1.0F));
    file.camera_above(2.0, 3.0, 1.5);
    return even(run.draw(file).image, glm::dvec3(0.8), {0.03, 0.02});
}

// A dielectric under a lamp without a size, and its neighbour in roughness, which has the same look.
Verdict near_neighbour(StressRun& run, double value, double neighbour, const Tolerance& tolerance) {
    const auto scene = [](double of) {
        SceneFile file;
        file.place(ground(4.0F), file.material(glm::vec3(0.5F), roughness(of, 0.0)));
        file.place(ball({0.0F, 0.4F, 0.0F}, 0.3F, 32), file.material({0.6F, 0.3F, 0.2F}, roughness(of, 0.0)));
        file.light({{"type", "point"}, {"power_w", 60.0}, {"radius_m", 0.0}},
                   glm::translate(glm::dmat4(1.0), glm::dvec3(1.0, 1.5, 0.7)));
        file.camera({0.3, 1.6, 2.2}, {0.0, 0.2, 0.0});
        return file;
    };
    return same(run.draw(scene(value)).image, run.draw(scene(neighbour)).image, tolerance);
}

Verdict smooth_dielectric(StressRun& run) {
    return near_neighbour(run, 0.0, 0.01, {0.1, 0.01});
}

Verdict rough_dielectric(StressRun& run) {
    return near_neighbour(run, 1.0, 0.99, {0.05, 0.01});
}

Verdict black_surface(StressRun& run) {
    return black_with_note(run.draw(sunlit(glm::vec3(0.0F))));
}

Verdict white_surface(StressRun& run) {
    return even(run.draw(sunlit(glm::vec3(1.0F))).image, glm::dvec3(1.0), {0.01, 0.002});
}

Verdict whiter_than_white(StressRun& run) {
    return even(run.draw(sunlit(glm::vec3(1.5F))).image, glm::dvec3(1.5), {0.01, 0.002});
}

// Closed within an albedo of 1, light never leaves: bounces are counted, so it does not grow without end.
Verdict white_room(StressRun& run) {
    const auto scene = [](float albedo) {
        SceneFile file;
        file.place(box({-1.0F, -1.0F, -1.0F}, {1.0F, 1.0F, 1.0F}), file.material(glm::vec3(albedo)));
        file.light({{"type", "point"}, {"power_w", 60.0}, {"radius_m", 0.0}},
                   glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.3, 0.0)));
        file.camera({0.6, 0.1, 0.7}, {-0.5, -0.4, -0.6});
        return file;
    };
    Settings two = StressRun::settings();
    two.bounces = 2;
    two.vpls = two.bounce_vpls = 256;
    // Direct light and two bounces: albedo, albedo^2 and albedo^3 of three pictures; a cubic through three
    // and 0.
    const Image half = run.draw(scene(0.5F), two).image;
    const Image quarter = run.draw(scene(0.25F), two).image;
    const Image threequarters = run.draw(scene(0.75F), two).image;
    Image expected = half;
    for (size_t i = 0; i < expected.rgb.size(); ++i) {
        expected.rgb[i] = 4.0F * quarter.rgb[i] - 6.0F * half.rgb[i] + 4.0F * threequarters.rgb[i];
    }
    return same(run.draw(scene(1.0F), two).image, expected, {0.3, 0.02});
}

SceneFile emitting(double strength) {
    SceneFile file;
    file.place(ground(4.0F), file.material(glm::vec3(0.8F)));
    file.root["extensionsUsed"].push_back("KHR_materials_emissive_strength");
    const int lamp = file.material(
        glm::vec3(0.0F),
        {{"emissiveFactor", {1, 1, 1}},
         {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", strength}}}}}});
    file.place(ball({0.0F, 0.8F, 0.0F}, 0.2F, 16), lamp);
    file.place(box({-0.5F, 0.0F, -0.5F}, {-0.3F, 0.4F, -0.3F}), 0);
    file.camera({0.3, 1.6, 2.2}, {0.0, 0.2, 0.0});
    return file;
}

Image times(Image image, float factor) {
    for (float& value : image.rgb) {
        value *= factor;
    }
    return image;
}

Verdict bright_emission(StressRun& run) {
    return same(run.draw(emitting(1e6)).image, times(run.draw(emitting(1.0)).image, 1e6F), {0.01, 0.001});
}

Verdict brighter_than_halves(StressRun& run) {
    return same(run.draw(emitting(1e12)).image, times(run.draw(emitting(1.0)).image, 1e12F), {0.01, 0.001});
}

Verdict bright_light(StressRun& run, double power_w) {
    const auto scene = [](double of) {
        SceneFile file;
        file.place(ground(4.0F), file.material(glm::vec3(0.5F), roughness(0.3, 0.0)));
        file.place(box({-0.5F, 0.0F, -0.5F}, {-0.1F, 0.6F, -0.1F}), 0);
        file.light({{"type", "point"}, {"power_w", of}, {"radius_m", 0.0}},
                   glm::translate(glm::dmat4(1.0), glm::dvec3(1.0, 1.5, 0.7)));
        file.camera({0.3, 1.6, 2.2}, {0.0, 0.2, 0.0});
        return file;
    };
    return same(run.draw(scene(power_w)).image,
                times(run.draw(scene(100.0)).image, static_cast<float>(power_w / 100.0)), {0.01, 0.001});
}

Verdict strongest_light(StressRun& run) {
    return bright_light(run, 1e20);
}

Verdict faintest_light(StressRun& run) {
    return bright_light(run, 1e-20);
}

}  // namespace

std::vector<StressCase> surface_cases() {
    return {
        {"a mirror of roughness 0 in an even world",
         "its colour: 3 %, mean 2 % of the lights that stand for the world", smooth_mirror},
        {"a dielectric of roughness 0", "as of 0.01: worst 10 %, mean 1 %; a highlight is less than a pixel",
         smooth_dielectric},
        {"a dielectric of roughness 1", "as of 0.99: worst 5 %, mean 1 %", rough_dielectric},
        {"albedo 0", "black, with a note", black_surface},
        {"albedo 1", "its radiance: 1 %, mean 0.2 %", white_surface},
        {"albedo 1.5", "half as much again as it receives, as in Cycles: 1 %, mean 0.2 %", whiter_than_white},
        {"closed room of albedo 1, two bounces",
         "the cubic through albedos 0.25 to 0.75: worst 30 % where lights are near, mean 2 %", white_room},
        {"emission 1e6", "1e6 times that of 1: worst 1 %, mean 0.1 % of halves", bright_emission},
        {"emission 1e12", "1e12 times that of 1: worst 1 %, mean 0.1 % of halves", brighter_than_halves},
        {"a light of 1e20 W", "1e18 times one of 100 W: worst 1 %, mean 0.1 % of halves", strongest_light},
        {"a light of 1e-20 W", "1e-22 times one of 100 W: worst 1 %, mean 0.1 % of halves", faintest_light},
    };
}

}  // namespace bounce::stress
