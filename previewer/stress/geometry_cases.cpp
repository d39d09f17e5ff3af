// SPDX-License-Identifier: Apache-2.0
//
// Surfaces that are hard to tell apart, to sample or to transform, and many of them.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <glm/gtc/matrix_transform.hpp>

#include "stress/stress.h"

namespace bounce::stress {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double k_albedo = 0.8;
const glm::vec3 k_gray(0.8F);

// A lamp beside what is looked at, and a camera aslant. Everything lies within about a metre of the origin.
void add_lamp_and_camera(SceneFile& file) {
    file.light({{"type", "point"}, {"power_w", 60.0}, {"radius_m", 0.0}},
               glm::translate(glm::dmat4(1.0), glm::dvec3(1.0, 1.5, 0.7)));
    file.camera({0.3, 1.6, 2.2}, {0.0, 0.2, 0.0});
}

Geometry block() {
    return box({-0.3F, 0.1F, -0.3F}, {0.3F, 0.7F, 0.3F});
}

// Ground, a block above it, a lamp.
SceneFile stage() {
    SceneFile file;
    file.place(ground(3.0F), file.material(k_gray));
    file.place(block(), file.material({0.7F, 0.3F, 0.2F}));
    add_lamp_and_camera(file);
    return file;
}

SceneFile stage_of(const Geometry& of_ground, const Geometry& of_block) {
    SceneFile file;
    file.place(of_ground, file.material(k_gray));
    file.place(of_block, file.material({0.7F, 0.3F, 0.2F}));
    add_lamp_and_camera(file);
    return file;
}

// The stage's block, its node transformed, against one whose corners are where that puts them.
Verdict transformed(StressRun& run, const glm::dmat4& matrix) {
    SceneFile by_node;
    by_node.place(ground(3.0F), by_node.material(k_gray));
    by_node.place(by_node.mesh(block(), by_node.material({0.7F, 0.3F, 0.2F})), matrix);
    add_lamp_and_camera(by_node);
    Geometry moved = block().moved(matrix);
    if (glm::determinant(matrix) < 0.0) {
        moved = moved.turned_inside_out();
    }
    // Points are sampled by where they are in the mesh, so that bounced light differs by their noise.
    return same(run.draw(by_node).image, run.draw(stage_of(ground(3.0F), moved)).image, {0.1, 0.01});
}

glm::dmat4 scaled(const glm::dvec3& by) {
    return glm::scale(glm::dmat4(1.0), by);
}

Verdict coincident(StressRun& run) {
    SceneFile twice = stage();
    twice.place(ground(3.0F), 0);
    twice.place(block(), 1);
    return same(run.draw(twice).image, run.draw(stage()).image, {0.1, 0.01});
}

Verdict coincident_colors(StressRun& run) {
    const auto scene = [](bool red, bool blue) {
        SceneFile file;
        if (red) file.place(ground(3.0F), file.material({0.8F, 0.0F, 0.0F}));
        if (blue) file.place(ground(3.0F), file.material({0.0F, 0.0F, 0.8F}));
        add_lamp_and_camera(file);
        return file;
    };
    const Image got = run.draw(scene(true, true)).image;
    const Image red = run.draw(scene(true, false)).image;
    const Image blue = run.draw(scene(false, true)).image;
    // Each pixel is one of the two.
    Image expected = red;
    for (size_t i = 0; i < got.rgb.size(); i += 3) {
        if (got.rgb[i + 2] > got.rgb[i]) {
            std::copy_n(&blue.rgb[i], 3, &expected.rgb[i]);
        }
    }
    return same(got, expected, {0.1, 0.01});
}

Verdict occluder_at_a_light(StressRun& run) {
    // Plates one millimetre above the lit ground: beside every virtual point light there is one.
    SceneFile file;
    file.place(ground(3.0F), file.material(k_gray));
    Geometry plates;
    for (int i = 0; i < 64; ++i) {
        const float x = -1.4F + 0.4F * static_cast<float>(i % 8);
        const float z = -1.4F + 0.4F * static_cast<float>(i / 8);
        plates.add(box({x, 0.001F, z}, {x + 0.1F, 0.002F, z + 0.1F}));
    }
    file.place(plates, 0);
    file.place(box({-1.5F, 0.0F, -1.5F}, {-1.4F, 1.5F, 1.5F}), 0);
    add_lamp_and_camera(file);
    Settings brute = StressRun::settings();
    brute.visibility = Visibility::shadow_maps;
    brute.ism_size = 64;
    brute.vpls = 256;
    brute.interleave = 1;
    return same(run.draw(file).image, run.draw(file, brute).image, {0.25, 0.03});
}

Verdict sub_pixel(StressRun& run) {
    // Squares a tenth of a pixel wide over a tenth of the ground, black on grey.
    SceneFile file;
    file.place(ground(3.0F), file.material(k_gray));
    Geometry specks;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> in(-1.4F, 1.4F);
    constexpr float width = 0.006F;
    for (int i = 0; i < 30'000; ++i) {
        const glm::vec3 p(in(random), 0.001F, in(random));
        specks.add_triangle(p, p + glm::vec3(0.0F, 0.0F, width), p + glm::vec3(width, 0.0F, width));
        specks.add_triangle(p, p + glm::vec3(width, 0.0F, width), p + glm::vec3(width, 0.0F, 0.0F));
    }
    file.place(specks, file.material(glm::vec3(0.0F)));
    file.light({{"type", "sun"}, {"irradiance_w_m2", pi}, {"angle_rad", 0}},
               looking({0.0, 0.0, 0.0}, {0.0, -1.0, 0.0}));
    file.camera_above(2.4, 3.0, 1.5);
    // What a random speck leaves: (1 - its share)^count.
    const double left = k_albedo * std::exp(-30'000.0 * width * width / (2.8 * 2.8));
    return even(run.draw(file).image, glm::dvec3(left), {2.0, 0.03});
}

Verdict needles(StressRun& run) {
    // The ground as a fan of triangles 3 m long and less than a millimetre wide.
    Geometry fan;
    constexpr int count = 8'000;
    for (int side = 0; side < 4; ++side) {
        const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), 0.5 * pi * side, glm::dvec3(0.0, 1.0, 0.0));
        for (int i = 0; i < count / 4; ++i) {
            const auto edge = [&](int k) {
                return glm::vec3(turn * glm::dvec4(-1.5 + 3.0 * k / (count / 4), 0.0, 1.5, 1.0));
            };
            fan.add_triangle(glm::vec3(0.0F), edge(i), edge(i + 1));
        }
    }
    return same(run.draw(stage_of(fan, block())).image, run.draw(stage()).image, {0.1, 0.01});
}

Verdict zero_area(StressRun& run) {
    SceneFile file = stage();
    Geometry nothing;
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 p(0.01F * static_cast<float>(i) - 1.5F, 0.3F, 0.4F);
        nothing.add_triangle(p, p, p);
        nothing.add_triangle(p, p + glm::vec3(0.1F, 0.0F, 0.0F), p + glm::vec3(0.2F, 0.0F, 0.0F));
        nothing.add_triangle(p, p, p + glm::vec3(0.0F, 0.2F, 0.0F));
    }
    file.place(nothing, 0);
    return same(run.draw(file).image, run.draw(stage()).image, {0.1, 0.01});
}

Verdict nothing_but_zero_area(StressRun& run) {
    SceneFile file;
    Geometry nothing;
    nothing.add_triangle({0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {2.0F, 0.0F, 0.0F});
    file.place(nothing, file.material(k_gray));
    add_lamp_and_camera(file);
    return black_with_note(run.draw(file));
}

Verdict inside_out(StressRun& run) {
    return same(run.draw(stage_of(ground(3.0F).turned_inside_out(), block().turned_inside_out())).image,
                run.draw(stage()).image, {0.1, 0.01});
}

Verdict non_manifold(StressRun& run) {
    // Three leaves at one edge, one of them turned around, one of them twice; no mesh of a solid.
    const auto leaf = [](double turn, bool other_side) {
        Geometry out;
        out.add_triangle({0.0F, 0.1F, 0.0F}, {0.5F, 0.1F, 0.0F}, {0.5F, 0.8F, 0.0F});
        out.add_triangle({0.0F, 0.1F, 0.0F}, {0.5F, 0.8F, 0.0F}, {0.0F, 0.8F, 0.0F});
        const Geometry turned = out.moved(glm::rotate(glm::dmat4(1.0), turn, glm::dvec3(0.0, 1.0, 0.0)));
        return other_side ? turned.turned_inside_out() : turned;
    };
    Geometry joined;
    for (int i = 0; i < 3; ++i) {
        joined.add(leaf(0.3 + 2.0 * i, i == 1));
    }
    joined.add(leaf(0.3, false));
    SceneFile apart;
    apart.place(ground(3.0F), apart.material(k_gray));
    const int color = apart.material({0.7F, 0.3F, 0.2F});
    for (int i = 0; i < 3; ++i) {
        apart.place(leaf(0.3 + 2.0 * i, false), color);
    }
    add_lamp_and_camera(apart);
    return same(run.draw(stage_of(ground(3.0F), joined)).image, run.draw(apart).image, {0.1, 0.01});
}

// Parts of a few millimetres on a triangle `wide` metres wide, under a sun; lengths times `unit`.
SceneFile small_parts(float wide) {
    SceneFile file;
    Geometry triangle;
    triangle.add_triangle({-0.5F * wide, 0.0F, 0.4F * wide}, {0.5F * wide, 0.0F, 0.4F * wide},
                          {0.0F, 0.0F, -0.6F * wide});
    file.place(triangle, file.material(k_gray));
    file.place(box({-0.003F, 0.0F, -0.003F}, {0.003F, 0.004F, 0.003F}), file.material({0.7F, 0.3F, 0.2F}));
    file.light({{"type", "sun"}, {"irradiance_w_m2", pi}, {"angle_rad", 0}},
               looking({0.0, 0.0, 0.0}, {-1.0, -1.5, -0.4}));
    file.camera({0.006, 0.016, 0.018}, {0.0, 0.001, 0.0}, 1e-4);
    return file;
}

Verdict wide_triangle(StressRun& run) {
    Settings direct = StressRun::settings();
    direct.technique = Technique::direct;
    return same(run.draw(small_parts(1e5F), direct).image, run.draw(small_parts(1.0F), direct).image,
                {2.0, 0.03});
}

Verdict non_uniform(StressRun& run) {
    return transformed(run, glm::rotate(glm::dmat4(1.0), 0.4, glm::dvec3(0.0, 1.0, 0.0)) *
                                scaled({2.0, 0.02, 0.5}) *
                                glm::rotate(glm::dmat4(1.0), 0.3, glm::dvec3(0.0, 0.0, 1.0)));
}

Verdict mirrored(StressRun& run) {
    return transformed(run, scaled({-1.0, 1.0, 0.7}));
}

Verdict flattened(StressRun& run) {
    return transformed(run, scaled({1.0, 0.0, 1.0}));
}

Verdict vanished(StressRun& run) {
    SceneFile file;
    file.place(ground(3.0F), file.material(k_gray));
    file.place(file.mesh(block(), 0), scaled(glm::dvec3(0.0)));
    add_lamp_and_camera(file);
    SceneFile without;
    without.place(ground(3.0F), without.material(k_gray));
    add_lamp_and_camera(without);
    return same(run.draw(file).image, run.draw(without).image, {0.1, 0.01});
}

Verdict millions_of_triangles(StressRun& run) {
    const int cells = run.full() ? 1600 : 160;  // 5,120,000 or 51,200 triangles
    return same(run.draw(stage_of(ground(3.0F, cells), block())).image, run.draw(stage()).image, {0.1, 0.01});
}

Verdict many_instances(StressRun& run) {
    const int side = run.full() ? 100 : 20;  // 10,000 or 400
    const auto low = [&](int i) {
        return glm::vec3(-1.4F + 2.8F * static_cast<float>(i % side) / static_cast<float>(side), 0.1F,
                         -1.4F + 2.8F * static_cast<float>(i / side) / static_cast<float>(side));
    };
    const float width = 1.2F / static_cast<float>(side);
    SceneFile instanced;
    instanced.place(ground(3.0F), instanced.material(k_gray));
    std::vector<float> places;
    Geometry all;
    for (int i = 0; i < side * side; ++i) {
        const glm::vec3 p = low(i);
        places.insert(places.end(), {p.x, p.y, p.z});
        all.add(box(p, p + glm::vec3(width)));
    }
    instanced.root["extensionsUsed"].push_back("EXT_mesh_gpu_instancing");
    const int of_mesh =
        instanced.mesh(box(glm::vec3(0.0F), glm::vec3(width)), instanced.material({0.7F, 0.3F, 0.2F}));
    instanced.node({{"mesh", of_mesh},
                    {"extensions",
                     {{"EXT_mesh_gpu_instancing",
                       {{"attributes", {{"TRANSLATION", instanced.accessor(places, "VEC3")}}}}}}}});
    add_lamp_and_camera(instanced);
    return same(run.draw(instanced).image, run.draw(stage_of(ground(3.0F), all)).image, {0.15, 0.01});
}

Verdict not_a_number(StressRun& run) {
    SceneFile file;
    Geometry broken = ground(3.0F);
    broken.positions[2].y = std::numeric_limits<float>::quiet_NaN();
    file.place(broken, file.material(k_gray));
    add_lamp_and_camera(file);
    return refused(run, file, ExitCode::input_refused, {"finite"}, StressRun::settings());
}

}  // namespace

std::vector<StressCase> geometry_cases() {
    constexpr const char* k_as_plain = "as the plain scene: worst 10 % of bounced light's noise, mean 1 %";
    return {
        {"two coincident surfaces of one colour", k_as_plain, coincident},
        {"two coincident surfaces of two colours", "each pixel one of both: worst 10 %, mean 1 %",
         coincident_colors},
        {"occluders 1 mm beside the virtual lights",
         "as maps of triangles and 256 lights: mean 3 %, worst 25 %", occluder_at_a_light},
        {"30,000 specks a tenth of a pixel wide", "the share of them in the mean, 3 %; single pixels scatter",
         sub_pixel},
        {"8,000 needle triangles", k_as_plain, needles},
        {"triangles of no area in the scene", k_as_plain, zero_area},
        {"triangles of no area alone", "black, with a note", nothing_but_zero_area},
        {"meshes turned inside out", k_as_plain, inside_out},
        {"a mesh that is no manifold", "as its leaves apart: worst 10 %, mean 1 %", non_manifold},
        {"a triangle of 100 km beside millimetres", "as on one of a metre: mean 3 %; shadows' rims scatter",
         wide_triangle},
        {"a node scaled unevenly", "as the same corners: worst 10 %, mean 1 %", non_uniform},
        {"a node mirrored", "as the same corners: worst 10 %, mean 1 %", mirrored},
        {"a node scaled to a plane", "as the same corners: worst 10 %, mean 1 %", flattened},
        {"a node scaled to nothing", "as without it: worst 10 %, mean 1 %", vanished},
        {"5,120,000 triangles (small: 51,200)", k_as_plain, millions_of_triangles},
        {"10,000 instances (small: 400)", "as one mesh: worst 15 %, mean 1 %", many_instances},
        {"a corner that is no number", "refused: the file is named, exit code 3", not_a_number},
    };
}

}  // namespace bounce::stress
