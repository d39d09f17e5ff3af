// SPDX-License-Identifier: Apache-2.0
//
// Pictures of odd sizes, and scenes that lack what a picture is made of.
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "stress/stress.h"

namespace bounce::stress {
namespace {

constexpr double pi = std::numbers::pi;

// Even light: a ground under a sun, whose radiance is its albedo.
SceneFile even_scene() {
    SceneFile file;
    file.place(ground(40.0F), file.material(glm::vec3(0.6F)));
    file.light({{"type", "sun"}, {"irradiance_w_m2", pi}, {"angle_rad", 0}},
               looking({0.0, 0.0, 0.0}, {0.0, -1.0, 0.0}));
    file.camera_above(2.0, 3.0, 1.5);
    return file;
}

Verdict of_size(StressRun& run, int width, int height) {
    Settings with = StressRun::settings();
    with.width = width;
    with.height = height;
    with.antialias = true;
    return even(run.draw(even_scene(), with).image, glm::dvec3(0.6), {0.01, 0.002});
}

Verdict one_pixel(StressRun& run) {
    return of_size(run, 1, 1);
}

Verdict odd_pixels(StressRun& run) {
    return of_size(run, 7, 3);
}

Verdict many_pixels(StressRun& run) {
    return run.full() ? of_size(run, 7680, 4320) : of_size(run, 480, 270);
}

// Bounced light takes blocks of pixels, which do not fit into so few.
SceneFile room() {
    SceneFile file;
    file.place(box({-1.0F, -1.0F, -1.0F}, {1.0F, 1.0F, 1.0F}), file.material(glm::vec3(0.5F)));
    file.light({{"type", "point"}, {"power_w", 60.0}, {"radius_m", 0.0}},
               glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.3, 0.0)));
    file.camera({0.6, 0.1, 0.7}, {-0.5, -0.4, -0.6});
    return file;
}

Verdict one_pixel_of_a_room(StressRun& run) {
    Settings one = StressRun::settings();
    one.width = one.height = 1;
    one.interleave = 8;
    Settings alone = one;
    alone.interleave = 1;
    return same(run.draw(room(), one).image, run.draw(room(), alone).image, {0.1, 0.1});
}

Verdict empty_scene(StressRun& run) {
    return black_with_note(run.draw(SceneFile{}));
}

Verdict empty_world(StressRun& run) {
    SceneFile file;
    file.world({0.2F, 0.4F, 0.6F});
    return even(run.draw(file).image, {0.2, 0.4, 0.6}, {0.001, 0.001});
}

Verdict no_light(StressRun& run) {
    SceneFile file;
    file.place(ground(4.0F), file.material(glm::vec3(0.8F)));
    file.camera_above(2.0, 3.0, 1.5);
    return black_with_note(run.draw(file));
}

Verdict no_camera(StressRun& run) {
    SceneFile file;
    file.place(ground(4.0F), file.material(glm::vec3(0.6F)));
    file.world(glm::vec3(1.0F));
    const Picture got = run.draw(file);
    // The ground reflects 0.6 of the world, and the world is seen beside it.
    const glm::dvec3 middle = got.at(got.image.width / 2, got.image.height / 2);
    const bool fits = std::abs(middle.r - 0.6) < 0.03 && std::abs(got.at(0, 0).r - 1.0) < 1e-3;
    return {fits, fmt::format("{:.3f} in the middle, {:.3f} in the corner", middle.r, got.at(0, 0).r),
            middle.r / 0.6 - 1.0};
}

Verdict camera_in_a_mesh(StressRun& run) {
    const auto scene = [](bool closed) {
        SceneFile file;
        file.place(ground(4.0F), file.material(glm::vec3(0.6F)));
        file.light({{"type", "sun"}, {"irradiance_w_m2", pi}, {"angle_rad", 0}},
                   looking({0.0, 0.0, 0.0}, {0.0, -1.0, 0.0}));
        if (closed) {
            file.place(box({-0.5F, 0.5F, -0.5F}, {0.5F, 1.5F, 0.5F}), 0);
        }
        file.camera({0.0, 1.0, 0.0}, {0.2, 0.4, 0.1});
        return file;
    };
    Settings direct = StressRun::settings();
    direct.technique = Technique::direct;
    const Picture lit = run.draw(scene(false));
    return both(black_with_note(run.draw(scene(true), direct)), at_most(run.draw(scene(true)), lit, 0.01));
}

Verdict camera_on_a_surface(StressRun& run) {
    // The ground cuts through the camera, which looks along it: above is the world, below the ground's dark
    // side.
    SceneFile file;
    file.place(ground(40.0F), file.material(glm::vec3(0.6F)));
    file.world(glm::vec3(1.0F));
    file.camera({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0});
    const Picture got = run.draw(file);
    const double above = got.at(24, 2).r;
    return {std::abs(above - 1.0) < 1e-3, fmt::format("{:.3f} above, {:.3f} below", above, got.at(24, 29).r),
            above - 1.0};
}

Verdict without_meshes_but_a_light(StressRun& run) {
    SceneFile file;
    file.light({{"type", "point"}, {"power_w", 60.0}, {"radius_m", 0.1}}, glm::dmat4(1.0));
    return black_with_note(run.draw(file));
}

}  // namespace

std::vector<StressCase> picture_cases() {
    return {
        {"a picture of 1x1", "the radiance: 1 %, mean 0.2 %", one_pixel},
        {"a picture of 7x3", "the radiance: 1 %, mean 0.2 %", odd_pixels},
        {"a picture of 7680x4320 (small: 480x270)", "the radiance: 1 %, mean 0.2 %", many_pixels},
        {"1x1 with bounced light in blocks of 8x8", "as without blocks: 10 %, another part of the lights",
         one_pixel_of_a_room},
        {"an empty scene", "black, with a note", empty_scene},
        {"a world alone", "its radiance: 0.1 %", empty_world},
        {"no light", "black, with a note", no_light},
        {"no camera", "the ground in the middle, within 3 %, and the world around it", no_camera},
        {"a camera in a closed mesh", "direct light black, with a note; bounced at most 1 % of the light without it", camera_in_a_mesh},
        {"a camera cut by the ground", "the world above the horizon: 0.1 %", camera_on_a_surface},
        {"a light and no mesh", "black, with a note", without_meshes_but_a_light},
    };
}

}  // namespace bounce::stress
