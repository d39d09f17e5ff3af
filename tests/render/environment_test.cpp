// SPDX-License-Identifier: Apache-2.0
//
// Images of the world: where they are seen, what they light, what mirrors them.
#include "scene/environment.h"

#include <functional>

#include <gmock/gmock.h>

#include "gpu/environment_brdf.h"
#include "ism_fixture.h"

namespace bounce::test {
namespace {

using ::testing::Contains;
using ::testing::Not;

class EnvironmentImage : public ::testing::Test {
  protected:
    static constexpr int size = 32;
    void SetUp() override { require_context(); }

    using Radiance = std::function<glm::dvec3(const glm::dvec3&)>;
    static scene::Scene under(const Radiance& radiance, int width = 256, float strength = 1.0F) {
        scene::Scene scene;
        scene.from_blender = true;
        scene.environment = scene::Environment{"test", width, width / 2, {}};
        for (int y = 0; y < width / 2; ++y) {
            for (int x = 0; x < width; ++x) {
                const glm::vec3 c(
                    radiance(scene::environment_direction((x + 0.5) / width, (y + 0.5) / (width / 2))));
                scene.environment->rgb.insert(scene.environment->rgb.end(), {c.r, c.g, c.b});
            }
        }
        scene.world.color = scene::mean_radiance(*scene.environment);
        scene.world.strength = strength;
        return scene;
    }
    static Settings lit_directly(int lights = 256) {
        Settings settings;
        settings.width = settings.height = size;
        settings.technique = Technique::direct;
        settings.world_vpls = lights;
        settings.antialias = false;
        return settings;
    }
    static glm::dvec3 middle(const Rendered& r) {
        glm::dvec3 sum(0.0);
        for (int y = size / 4; y < 3 * size / 4; ++y) {
            for (int x = size / 4; x < 3 * size / 4; ++x) {
                sum += r.at(x, y);
            }
        }
        return sum / (0.25 * size * size);
    }
    // From the origin along a direction of the world (not the vertical).
    static CameraView camera_along(const glm::dvec3& direction) {
        CameraView view;
        view.world_from_camera = glm::inverse(glm::lookAt(glm::dvec3(0.0), direction, glm::dvec3(0, 1, 0)));
        view.camera.perspective = true;
        view.camera.yfov_rad = 0.6F;
        return view;
    }
    static int add_metal(scene::Scene& scene, float roughness, float metallic = 1.0F) {
        const int index = add_diffuse(scene);
        scene.materials[static_cast<size_t>(index)].metallic = metallic;
        scene.materials[static_cast<size_t>(index)].roughness = roughness;
        scene.materials[static_cast<size_t>(index)].specular = 0.5F;
        return index;
    }
    // Four colours around the horizon, and half of each below it.
    static glm::dvec3 quadrants(const glm::dvec3& d) {
        const glm::dvec3 side = std::abs(d.x) > std::abs(d.z)
                                    ? (d.x > 0 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0))
                                    : (d.z > 0 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 1, 0));
        return d.y > 0.0 ? side : 0.5 * side;
    }
    // Images, and what a white plane that faces +Z reflects of them. An even one: its radiance; one that
    // falls off as the cosine from +Z: 2/3 of it; a patch about a slanted direction: 2 pi (1 / 20 - 1 / 400)
    // cos / pi.
    static std::vector<std::pair<Radiance, double>> plane_cases() {
        const glm::dvec3 to_patch = glm::normalize(glm::dvec3(0.5, 0.2, 0.8));
        return {
            {[](const glm::dvec3&) { return glm::dvec3(2.0); }, 2.0},
            {[](const glm::dvec3& d) { return glm::dvec3(std::max(d.z, 0.0)); }, 2.0 / 3.0},
            {[=](const glm::dvec3& d) { return glm::dvec3(std::exp(20.0 * (glm::dot(d, to_patch) - 1.0))); },
             2.0 * (1.0 / 20.0 - 1.0 / 400.0) * to_patch.z},
        };
    }
};

TEST_F(EnvironmentImage, IsSeenWhereItIs) {
    const double c = std::cos(0.1);
    for (const double turn : {0.0, 90.0}) {
        scene::Scene scene = under(quadrants);
        const glm::dmat3 rotation(rotated(turn, {0.0, 1.0, 0.0}));
        scene.world.world_from_environment = glm::quat_cast(rotation);
        for (const glm::dvec3& d : {glm::dvec3(c, 0.1, 0), glm::dvec3(-c, -0.1, 0), glm::dvec3(0, 0.1, c),
                                    glm::dvec3(0, -0.1, -c)}) {
            const glm::dvec3 expected = quadrants(d);
            const Rendered r = draw(scene, camera_along(rotation * d), lit_directly());
            EXPECT_LT(glm::length(r.at(size / 2, size / 2) - expected), 1e-4)
                << d.x << ' ' << d.z << ' ' << turn;
            // The picture's upper part looks up.
            EXPECT_LT(glm::length(r.at(size / 2, 1) - quadrants({d.x, 0.3, d.z})), 1e-4);
            EXPECT_LT(glm::length(r.at(size / 2, size - 2) - quadrants({d.x, -0.3, d.z})), 1e-4);
        }
    }
}

TEST_F(EnvironmentImage, AnOrthographicCameraSeesOneDirection) {
    const scene::Scene scene = under([](const glm::dvec3& d) { return 0.5 * (d + 1.0); });
    CameraView view = camera_along({0.6, 0.0, -0.8});
    view.camera.perspective = false;
    view.camera.far_m = 2.0F;  // no farther than the frame is wide
    const Rendered r = draw(scene, view, lit_directly());
    for (const int x : {0, size / 2, size - 1}) {
        EXPECT_LT(glm::length(r.at(x, x) - glm::dvec3(0.8, 0.5, 0.1)), 0.005);
    }
}

TEST_F(EnvironmentImage, EveryPixelLooksAlongItsOwnRay) {
    const scene::Scene scene = under([](const glm::dvec3& d) { return 0.5 * (d + 1.0); }, 1024);
    const CameraView view = camera_along(glm::normalize(glm::dvec3(0.3, 0.4, 0.86)));
    const Rendered r = draw(scene, view, lit_directly());
    const double half = std::tan(0.3);
    for (const auto& [x, y] : {std::pair(0, 0), std::pair(31, 5), std::pair(10, 30)}) {
        const glm::dvec3 ray((2.0 * (x + 0.5) / size - 1.0) * half, (1.0 - 2.0 * (y + 0.5) / size) * half,
                             -1.0);
        const glm::dvec3 d = glm::normalize(glm::dmat3(view.world_from_camera) * ray);
        EXPECT_LT(glm::length(r.at(x, y) - 0.5 * (d + 1.0)), 0.003) << x << ' ' << y;
    }
}

TEST_F(EnvironmentImage, APlaneShowsWhatItGathers) {
    // Facing the camera, +Z.
    const std::vector<std::pair<Radiance, double>> cases = plane_cases();
    for (size_t i = 0; i < cases.size(); ++i) {
        scene::Scene scene = under(cases[i].first, 256, 3.0F);
        add_mesh_node(scene, add_square(scene, 20.0F, add_diffuse(scene, glm::vec3(0.5F))), glm::dmat4(1.0));
        const Rendered r = draw(scene, camera_from_above(4.0, 50.0), lit_directly());
        EXPECT_NEAR(middle(r).g / (1.5 * cases[i].second), 1.0, 0.015)
            << i << ": 256 lights, and texels of the image";
    }
}

// The same of lights drawn from the sphere's cells, whatever they are drawn by, with the image turned about
// the plane's normal, which changes nothing.
TEST_F(EnvironmentImage, LightsDrawnFromItsCellsGatherTheSame) {
    const std::vector<std::pair<Radiance, double>> cases = plane_cases();
    for (size_t i = 0; i < cases.size(); ++i) {
        scene::Scene scene = under(cases[i].first, 256, 3.0F);
        scene.world.world_from_environment = glm::quat_cast(glm::dmat3(rotated(40.0, {0.0, 0.0, 1.0})));
        add_mesh_node(scene, add_square(scene, 20.0F, add_diffuse(scene, glm::vec3(0.5F))), glm::dmat4(1.0));
        // One renderer for all: what takes long is to make it, its programs and the image's maps.
        Renderer renderer(scene);
        const scene::Pose pose = scene::evaluate_pose(scene, 0.0);
        for (const VplSampling sampling :
             {VplSampling::inverse_transform, VplSampling::inverse3, VplSampling::uniform3,
              VplSampling::metropolis, VplSampling::metropolis_single, VplSampling::resampled}) {
            for (const Importance importance : {Importance::flux, Importance::view}) {
                Settings settings = lit_directly(2048);
                settings.world_sampling = WorldSampling::drawn;
                settings.vpl_sampling = sampling;
                settings.vpl_importance = importance;
                settings.importance_pixels = 5.0F;
                const Rendered r = draw(renderer, pose, camera_from_above(4.0, 50.0), settings);
                // 5 %: of 2,048 lights few are in the patch where they are drawn evenly, and Metropolis has
                // its bias; the others are within 2 %.
                const bool coarse = sampling == VplSampling::uniform3 ||
                                    sampling == VplSampling::metropolis ||
                                    sampling == VplSampling::metropolis_single;
                EXPECT_NEAR(middle(r).g / (1.5 * cases[i].second), 1.0, coarse ? 0.05 : 0.02)
                    << i << ", sampling " << static_cast<int>(sampling) << ", by "
                    << (importance == Importance::view ? "view" : "flux");
                EXPECT_THAT(r.report.executed, Contains("sphere vpls"));
            }
        }
    }
}

TEST_F(EnvironmentImage, AWhiteBallShowsAnEvenImage) {
    // 2 % as in WorldLight.AWhiteBallShowsTheWorld.
    scene::Scene scene = under([](const glm::dvec3&) { return glm::dvec3(1.0); });
    add_mesh_node(scene, add_ball(scene, add_diffuse(scene), 1.0F), glm::dmat4(1.0));
    EXPECT_NEAR(middle(draw(scene, camera_from_above(1.6, 5.0), lit_directly())).g, 1.0, 0.02);
}

TEST_F(EnvironmentImage, MetalReflectsWhatItsLobeGathers) {
    // A square that faces the camera, under an even image of 1: the lobe's share of an even world, by the
    // table. At roughness 0 all of it.
    for (const float roughness : {0.0F, 0.3F, 0.6F, 1.0F}) {
        scene::Scene scene = under([](const glm::dvec3&) { return glm::dvec3(1.0); });
        add_mesh_node(scene, add_square(scene, 20.0F, add_metal(scene, roughness)), glm::dmat4(1.0));
        const double found = middle(draw(scene, camera_from_above(4.0, 50.0), lit_directly())).g;
        const glm::dvec2 part = gpu::environment_brdf(1.0, static_cast<double>(roughness));
        EXPECT_NEAR(found, part.x + part.y, 0.01) << roughness;
    }
}

TEST_F(EnvironmentImage, RoughMetalFromAsideHasItsLobesFirstMoment) {
    // Radiance linear in direction: what a lobe gathers of it is exactly its sum and its first moment, which
    // are integrated here over a grid of directions by the law itself. 2 %: lobes between two of the levels
    // are given the height of their middle, not their moment.
    const glm::dvec3 slope(0.6, 0.0, -0.7);
    const double turn = 60.0;
    const glm::dvec3 n(std::sin(turn * pi / 180.0), 0.0, std::cos(turn * pi / 180.0));
    const glm::dvec3 t(n.z, 0.0, -n.x);
    for (const double roughness : {0.3, 0.6, 0.8, 1.0}) {
        const double alpha2 = std::pow(roughness, 4.0);
        const auto smith = [&](double c) {
            return 2.0 * c / (c + std::sqrt(c * c * (1.0 - alpha2) + alpha2));
        };
        double expected = 0.0;
        constexpr int k_steps = 1000;
        for (int i = 0; i < k_steps; ++i) {
            for (int j = 0; j < k_steps; ++j) {
                // Even over the hemisphere's solid angle.
                const double c = (i + 0.5) / k_steps;
                const double phi = 2.0 * pi * (j + 0.5) / k_steps;
                const double sine = std::sqrt(1.0 - c * c);
                const glm::dvec3 l =
                    sine * std::cos(phi) * t + glm::dvec3(0.0, sine * std::sin(phi), 0.0) + c * n;
                const double h = glm::dot(glm::normalize(l + glm::dvec3(0, 0, 1)), n);
                const double d = h * h * (alpha2 - 1.0) + 1.0;
                const double reflected = alpha2 / (pi * d * d) * smith(c) * smith(n.z) / (4.0 * n.z);
                expected += reflected * (1.0 + glm::dot(slope, l)) * 2.0 * pi / (k_steps * k_steps);
            }
        }
        scene::Scene scene = under([&](const glm::dvec3& d) { return glm::dvec3(1.0 + glm::dot(slope, d)); });
        const int material = add_metal(scene, static_cast<float>(roughness));
        add_mesh_node(scene, add_square(scene, 40.0F, material), rotated(turn, {0.0, 1.0, 0.0}));
        const double found = middle(draw(scene, camera_from_above(2.0, 50.0), lit_directly())).g;
        EXPECT_NEAR(found / expected, 1.0, 0.02) << roughness;
    }
}

TEST_F(EnvironmentImage, BlackPlasticReflectsMoreAtAGrazingView) {
    // Seen at 75 degrees: 0.04 of the first part and all of the second, which is most of it.
    for (const float roughness : {0.0F, 0.3F, 0.6F}) {
        scene::Scene scene = under([](const glm::dvec3&) { return glm::dvec3(1.0); });
        const int material = add_metal(scene, roughness, 0.0F);
        scene.materials[static_cast<size_t>(material)].base_color = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
        add_mesh_node(scene, add_square(scene, 40.0F, material), rotated(75.0, {0.0, 1.0, 0.0}));
        const double found = middle(draw(scene, camera_from_above(2.0, 50.0), lit_directly())).g;
        const glm::dvec2 part =
            gpu::environment_brdf(std::cos(75.0 * pi / 180.0), static_cast<double>(roughness));
        EXPECT_NEAR(found, 0.04 * part.x + part.y, 0.01) << roughness;
    }
}

TEST_F(EnvironmentImage, AMirrorShowsItSharply) {
    // Square at 45 degrees: the camera looks along -Z and sees what lies along +X, or, off the middle, what
    // its own ray is mirrored to. One degree beside an edge of the image there is nothing of the other side.
    const auto edge = [](const glm::dvec3& d) {
        return d.z > 0.0 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    };
    scene::Scene scene = under(edge, 1024);
    add_mesh_node(scene, add_square(scene, 20.0F, add_metal(scene, 0.0F)), rotated(45.0, {0.0, 1.0, 0.0}));
    CameraView camera = camera_from_above(1.0, 5.0);
    camera.camera.perspective = true;
    camera.camera.yfov_rad = 0.2F;
    camera.camera.far_m = 100.0F;
    const Rendered r = draw(scene, camera, lit_directly());
    // A ray (x, 0, -1) becomes (1, 0, -x): right of the middle it goes to -Z.
    EXPECT_LT(glm::length(r.at(size / 2 + 4, size / 2) - glm::dvec3(0, 1, 0)), 0.02);
    EXPECT_LT(glm::length(r.at(size / 2 - 5, size / 2) - glm::dvec3(1, 0, 0)), 0.02);
}

TEST_F(EnvironmentImage, WhatIsHiddenIsNotReflected) {
    // In a closed room there is no world to be mirrored.
    scene::Scene scene = under([](const glm::dvec3&) { return glm::dvec3(1.0); });
    const int square = add_square(scene, 2.0F, add_metal(scene, 0.3F));
    const double turns[6][4] = {{0, 1, 0, 0},  {90, 1, 0, 0},  {-90, 1, 0, 0},
                                {90, 0, 1, 0}, {-90, 0, 1, 0}, {180, 1, 0, 0}};
    for (const auto& t : turns) {
        add_mesh_node(scene, square, rotated(t[0], {t[1], t[2], t[3]}) * moved({0.0, 0.0, -1.0}));
    }
    CameraView camera = camera_from_above(1.9, 0.5);
    camera.camera.far_m = 10.0F;
    EXPECT_LT(draw(scene, camera, lit_directly()).mean(), 0.002);
}

TEST_F(EnvironmentImage, ItsSunThrowsAHardShadow) {
    // Black but for a sun of 0.6 degrees above: a box's shadow on the ground is dark, beside it the ground
    // shows the sun's irradiance over pi. Between, within a hundredth of the box's height, both are met.
    const glm::dvec3 from = glm::normalize(glm::dvec3(1.0, 0.0, 1.0));
    scene::Scene scene = under(
        [&](const glm::dvec3& d) { return glm::dvec3(glm::dot(d, from) > std::cos(0.0052) ? 1e4 : 0.0); },
        2048);
    double irradiance = 0.0;
    for (int y = 0; y < 1024; ++y) {
        for (int x = 0; x < 2048; ++x) {
            const size_t i = 3 * (static_cast<size_t>(y) * 2048 + static_cast<size_t>(x));
            irradiance +=
                static_cast<double>(scene.environment->rgb[i]) * scene::environment_texel_sr(2048, 1024, y);
        }
    }
    add_mesh_node(scene, add_square(scene, 20.0F, add_diffuse(scene)), glm::dmat4(1.0));
    add_mesh_node(scene, add_box(scene, glm::vec3(0.5F), add_diffuse(scene, glm::vec3(0.0F))),
                  moved({0.0, 0.0, 0.5}));
    CameraView camera = camera_from_above(0.2, 20.0);
    // The shadow of the edge (0.5, 1) falls to x = -0.5 - 1 at the far side.
    const auto at = [&](double x) {
        CameraView view = camera;
        view.world_from_camera = moved({x, 0.0, 0.0}) * camera.world_from_camera;
        return middle(draw(scene, view, lit_directly())).g;
    };
    EXPECT_LT(at(-1.3), 1e-4);
    EXPECT_NEAR(at(-1.7) / (irradiance * std::sqrt(0.5) / pi), 1.0, 0.01);
}

TEST_F(EnvironmentImage, ABlackOneCostsNothing) {
    scene::Scene scene = under([](const glm::dvec3&) { return glm::dvec3(0.0); });
    add_mesh_node(scene, add_square(scene, 2.0F, add_diffuse(scene)), glm::dmat4(1.0));
    const Rendered r = draw(scene, camera_from_above(1.0, 5.0), lit_directly());
    EXPECT_THAT(r.report.executed, Not(Contains("ism disks")));
    EXPECT_EQ(r.mean(), 0.0);
}

}  // namespace
}  // namespace bounce::test
