// SPDX-License-Identifier: Apache-2.0
//
// Lights where they are hard to place, of sizes and cones at their limits, and many of them.
#include <cmath>
#include <functional>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "stress/stress.h"

namespace bounce::stress {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double k_albedo = 0.8;
const glm::dmat4 k_down = looking({0.0, 0.0, 0.0}, {0.0, -1.0, 0.0});
const glm::dmat4 k_up = looking({0.0, 0.0, 0.0}, {0.0, 1.0, 0.0});

glm::dmat4 at(const glm::dvec3& place, const glm::dmat4& turn = k_down) {
    return glm::translate(glm::dmat4(1.0), place) * turn;
}

nlohmann::json point(double power_w, double radius_m = 0.0) {
    return {{"type", "point"}, {"power_w", power_w}, {"radius_m", radius_m}};
}

nlohmann::json spot(double power_w, double cone_rad) {
    return {
        {"type", "spot"}, {"power_w", power_w}, {"radius_m", 0}, {"cone_angle_rad", cone_rad}, {"blend", 0}};
}

nlohmann::json sun(double irradiance) {
    return {{"type", "sun"}, {"irradiance_w_m2", irradiance}, {"angle_rad", 0}};
}

nlohmann::json area(double power_w, double size) {
    return {{"type", "area"},   {"power_w", power_w}, {"shape", "square"},
            {"size_x_m", size}, {"size_y_m", size},   {"spread_rad", pi}};
}

// Ground of 4 m under a camera that sees `width` metres of it.
SceneFile above_ground(double width, const glm::dvec3& over = glm::dvec3(0.0)) {
    SceneFile file;
    file.place(ground(4.0F), file.material(glm::vec3(static_cast<float>(k_albedo))));
    file.camera_above(width, 3.0, 1.5, over);
    return file;
}

// The radiance of a Lambertian ground under this irradiance, at the middles of pixels.
Image lit_ground(double width, const std::function<double(double, double)>& irradiance) {
    const Settings s = StressRun::settings();
    Image out(s.width, s.height);
    for (int y = 0; y < s.height; ++y) {
        for (int x = 0; x < s.width; ++x) {
            const double east = ((x + 0.5) / s.width - 0.5) * width;
            const double south = ((y + 0.5) / s.height - 0.5) * width / 1.5;
            for (size_t channel = 0; channel < 3; ++channel) {
                out.rgb[out.offset(x, y) + channel] =
                    static_cast<float>(k_albedo / pi * irradiance(east, south));
            }
        }
    }
    return out;
}

// Irradiance on the ground, W/m^2, of a point of this intensity, W/sr, `height` above (east, south).
double of_point(double intensity, double height, double east, double south) {
    const double squared = east * east + south * south + height * height;
    return intensity * height / (squared * std::sqrt(squared));
}

Verdict one_millimetre_above(StressRun& run) {
    SceneFile file = above_ground(2.0);
    file.light(point(100.0), at({0.0, 0.001, 0.0}));
    const Image expected = lit_ground(
        2.0, [](double east, double south) { return of_point(100.0 / (4.0 * pi), 0.001, east, south); });
    return same(run.draw(file).image, expected, {0.02, 0.01});
}

Verdict in_the_ground(StressRun& run) {
    SceneFile file = above_ground(2.0);
    file.light(point(100.0), at({0.0, 0.0, 0.0}));
    SceneFile above = above_ground(2.0);
    above.light(point(100.0), at({0.0, 1.0, 0.0}));
    return at_most(run.draw(file), run.draw(above), 1e-4);
}

Verdict ball_on_the_ground(StressRun& run) {
    SceneFile touching = above_ground(2.0);
    touching.light(point(100.0, 0.1), at({0.0, 0.1, 0.0}));
    SceneFile close = above_ground(2.0);
    close.light(point(100.0, 0.1), at({0.0, 0.1001, 0.0}));
    return same(run.draw(touching).image, run.draw(close).image, {0.03, 0.01});
}

Verdict area_on_the_ground(StressRun& run) {
    SceneFile file = above_ground(0.5);
    file.light(area(40.0, 2.0), at({0.0, 0.001, 0.0}));
    const double radiance = 40.0 / (4.0 * 4.0);
    return even(run.draw(file).image, glm::dvec3(k_albedo * radiance), {0.02, 0.01});
}

Verdict in_a_closed_box(StressRun& run) {
    const auto scene = [](bool closed) {
        SceneFile file = above_ground(3.0);
        file.light(point(100.0), at({0.0, 0.4, 0.0}));
        if (closed) {
            file.place(box({-0.2F, 0.2F, -0.2F}, {0.2F, 0.6F, 0.2F}), file.material(glm::vec3(0.8F)));
        }
        return file;
    };
    Settings direct = StressRun::settings();
    direct.technique = Technique::direct;
    const Picture lit = run.draw(scene(false));
    return both(at_most(run.draw(scene(true), direct), lit, 0.0), at_most(run.draw(scene(true)), lit, 0.01));
}

Verdict behind_a_thin_wall(StressRun& run) {
    const auto scene = [](double side) {
        SceneFile file = above_ground(1.0, {side, 0.0, 0.0});
        file.place(box({-0.0005F, 0.0F, -2.0F}, {0.0005F, 2.0F, 2.0F}), file.material(glm::vec3(0.8F)));
        file.light(point(100.0), at({-1.0, 1.0, 0.0}));
        return file;
    };
    Settings direct = StressRun::settings();
    direct.technique = Technique::direct;
    const Picture lit = run.draw(scene(-1.0));
    return both(at_most(run.draw(scene(1.0), direct), lit, 0.0), at_most(run.draw(scene(1.0)), lit, 0.01));
}

Verdict needle_spot(StressRun& run) {
    SceneFile file = above_ground(0.008);
    file.light(spot(100.0, 0.1 * pi / 180.0), at({0.0, 2.0, 0.0}));
    // The picture lies within the spot's 1.7 mm only in part.
    const Image expected = lit_ground(0.008, [](double east, double south) {
        return std::hypot(east, south) < 2.0 * std::tan(0.05 * pi / 180.0)
                   ? of_point(100.0 / (4.0 * pi), 2.0, east, south)
                   : 0.0;
    });
    return same(run.draw(file).image, expected, {1.0, 0.03});
}

Verdict half_space_spot(StressRun& run) {
    SceneFile file = above_ground(2.0);
    file.light(spot(100.0, pi), at({0.0, 1.0, 0.0}));
    // A spot of Blender 3 dims by the cosine to its axis.
    const Image expected = lit_ground(2.0, [](double east, double south) {
        const double cosine = 1.0 / std::sqrt(1.0 + east * east + south * south);
        return of_point(100.0 / (4.0 * pi) * cosine, 1.0, east, south);
    });
    return same(run.draw(file).image, expected, {0.02, 0.01});
}

Verdict closed_spot(StressRun& run) {
    SceneFile file = above_ground(2.0);
    file.light(spot(100.0, 0.0), at({0.0, 1.0, 0.0}));
    return black_with_note(run.draw(file));
}

Verdict sun_from_below(StressRun& run) {
    SceneFile file = above_ground(2.0);
    file.light(sun(3.0), k_up);
    return black_with_note(run.draw(file));
}

Verdict level_sun(StressRun& run) {
    SceneFile file = above_ground(2.0);
    file.light(sun(3.0), looking({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}));
    return black_with_note(run.draw(file));
}

Verdict area_without_size(StressRun& run) {
    SceneFile none = above_ground(2.0);
    none.light(area(40.0, 0.0), at({0.0, 1.0, 0.0}));
    return black_with_note(run.draw(none));
}

Verdict area_without_end(StressRun& run) {
    SceneFile file = above_ground(2.0);
    file.light(area(4e8, 1e4), at({0.0, 1.0, 0.0}));
    return even(run.draw(file).image, glm::dvec3(k_albedo), {0.02, 0.01});
}

Verdict scaled_light(StressRun& run) {
    // A light's node may be squeezed to nothing; only an area light has a size that this changes.
    SceneFile squeezed = above_ground(2.0);
    squeezed.light(point(100.0), at({0.0, 1.0, 0.0}, glm::scale(glm::dmat4(1.0), glm::dvec3(0.0))));
    const Image expected = lit_ground(
        2.0, [](double east, double south) { return of_point(100.0 / (4.0 * pi), 1.0, east, south); });
    return same(run.draw(squeezed).image, expected, {0.02, 0.01});
}

Verdict many_lights(StressRun& run) {
    const int side = run.full() ? 32 : 8;  // 1,024
    const auto place = [side](int i) { return ((i + 0.5) / side - 0.5) * 4.0; };
    SceneFile file = above_ground(2.0);
    for (int i = 0; i < side * side; ++i) {
        file.light(point(1.0), at({place(i % side), 0.5, place(i / side)}));
    }
    const Image expected = lit_ground(2.0, [&](double east, double south) {
        double sum = 0.0;
        for (int i = 0; i < side * side; ++i) {
            sum += of_point(1.0 / (4.0 * pi), 0.5, east - place(i % side), south - place(i / side));
        }
        return sum;
    });
    return same(run.draw(file).image, expected, {0.02, 0.01});
}

}  // namespace

std::vector<StressCase> light_cases() {
    return {
        {"point light 1 mm above the ground", "its formula at each pixel: 2 % of grazing rounding, mean 1 %",
         one_millimetre_above},
        {"point light in the ground", "at most 1e-4 of what it gives a metre above: rounding leaves it a cosine", in_the_ground},
        {"ball of light touching the ground", "as a tenth of a millimetre higher: worst 3 %, mean 1 %",
         ball_on_the_ground},
        {"area light 1 mm above the ground", "its radiance times the albedo: 2 %, mean 1 %",
         area_on_the_ground},
        {"light in a closed box", "direct light none; bounced at most 1 % of what it is without the box",
         in_a_closed_box},
        {"light behind a wall 1 mm thick", "direct light none; bounced at most 1 % of the lit side",
         behind_a_thin_wall},
        {"spot of 0.1 degrees", "its formula within a disk of 1.7 mm: mean 3 %, its rim cuts pixels",
         needle_spot},
        {"spot of 180 degrees", "its formula at each pixel: 2 %, mean 1 %", half_space_spot},
        {"spot of 0 degrees", "black, with a note", closed_spot},
        {"sun from below the ground", "black, with a note", sun_from_below},
        {"sun along the ground", "black, with a note", level_sun},
        {"area light of no size", "black, with a note: to Cycles it has no surface to send light from", area_without_size},
        {"area light of 10 km", "its radiance times the albedo: 2 %, mean 1 %", area_without_end},
        {"point light of a node scaled to 0", "as without the scale: 2 %, mean 1 %", scaled_light},
        {"1,024 lights (small: 64)", "the sum of their formulas: 2 %, mean 1 %", many_lights},
    };
}

}  // namespace bounce::stress
