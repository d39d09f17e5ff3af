// SPDX-License-Identifier: Apache-2.0
//
// Light traced through the approximate visibility grid: none is lost or made, and none passes a surface.
#include <cstring>

#include "avg_fixture.h"
#include "renderer/settings_check.h"

namespace bounce::test {
namespace {

class AvgTrace : public ::testing::Test {
  protected:
    void SetUp() override { require_context(); }

    // A closed box of half side 1 and a light in it; walls of n x n squares each.
    static scene::Scene box(const glm::vec3& albedo, int n, const glm::dmat4& turned,
                            const scene::Light& light, const glm::dmat4& light_at) {
        scene::Scene scene;
        scene.from_blender = true;
        add_mesh_node(scene,
                      add_triangles(scene, box_triangles(glm::vec3(1.0F), n), add_diffuse(scene, albedo)),
                      turned);
        add_light(scene, light, turned * light_at);
        return scene;
    }
    static scene::Light point() { return light_of(scene::LightType::point); }

    // Largest distance of a lit light from the middle along the axes of a turned box: above 1 is outside.
    static double farthest(const Traced& traced_, const glm::dmat4& turned) {
        double most = 0.0;
        for (const auto& bounce : traced_.bounces) {
            for (const gpu::GpuVpl& vpl : bounce) {
                if (!is_dark(vpl)) {
                    const glm::dvec3 at =
                        glm::abs(glm::dvec3(glm::inverse(turned) * glm::dvec4(traced_.place(vpl), 1.0)));
                    most = std::max({most, at.x, at.y, at.z});
                }
            }
        }
        return most;
    }
    static int dark(const std::vector<gpu::GpuVpl>& bounce) {
        return static_cast<int>(std::count_if(bounce.begin(), bounce.end(), is_dark));
    }
};

TEST_F(AvgTrace, OfAFurnaceKeepsAllLightButWhatWallsTake) {
    // A closed box reflects albedo^k of the light's power at bounce k. 100 W of radiant flux.
    for (const double degrees : {0.0, 15.0}) {
        for (const AvgPaths paths : {AvgPaths::roulette, AvgPaths::fixed}) {
            const scene::Scene scene = box(glm::vec3(0.8F, 0.5F, 0.2F), 1, rotated(degrees, {0.2, 1.0, 0.1}),
                                           point(), moved({0.2, 0.1, -0.3}));
            Settings settings = traced(32, 4);
            settings.avg_paths = paths;
            const Traced result = trace(scene, settings);
            glm::dvec3 expected(100.0);
            for (size_t k = 0; k < 4; ++k) {
                expected *= glm::dvec3(0.8, 0.5, 0.2);
                const glm::dvec3 flux = result.flux_w(k);
                for (int c = 0; c < 3; ++c) {
                    // Every ray ends in the same colour, so that there is no noise: rounding alone.
                    EXPECT_NEAR(flux[c] / expected[c], 1.0, 1e-4)
                        << "bounce " << k + 1 << ", channel " << c << ", turned by " << degrees << ", paths "
                        << static_cast<int>(paths);
                }
                EXPECT_EQ(dark(result.bounces[k]), 0);
            }
        }
    }
}

// Flux that the walls of a box of half side 1 reflect of each bounce, W, of 100 W from its middle: paths of
// random directions, whose ends on the box are exact. albedo: of each wall, 2 * axis + side.
std::array<double, 3> paths_in_a_box(const std::array<double, 6>& albedo, int paths) {
    std::mt19937 random(17);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    std::array<double, 3> out{};
    for (int i = 0; i < paths; ++i) {
        glm::dvec3 at(0.0);
        const double z = 2.0 * part(random) - 1.0;
        const double turn = 2.0 * pi * part(random);
        glm::dvec3 way(std::sqrt(1.0 - z * z) * std::cos(turn), std::sqrt(1.0 - z * z) * std::sin(turn), z);
        double flux = 100.0 / paths;
        for (double& bounce : out) {
            const glm::dvec3 ends = (glm::sign(way) - at) / way;
            const int axis = ends.x <= ends.y && ends.x <= ends.z ? 0 : ends.y <= ends.z ? 1 : 2;
            at += way * ends[axis];
            const double side = way[axis] > 0.0 ? 1.0 : -1.0;
            at[axis] = side;
            flux *= albedo[static_cast<size_t>(2 * axis + (side > 0.0 ? 1 : 0))];
            bounce += flux;
            const double u = part(random);
            const double v = 2.0 * pi * part(random);
            way[axis] = -side * std::sqrt(1.0 - u);
            way[(axis + 1) % 3] = std::sqrt(u) * std::cos(v);
            way[(axis + 2) % 3] = std::sqrt(u) * std::sin(v);
        }
    }
    return out;
}

TEST_F(AvgTrace, OfWallsOfUnlikeColoursKeepsTheLightWithinNoise) {
    const std::array<double, 6> albedo = {0.9, 0.9, 0.3, 0.3, 0.1, 0.6};
    scene::Scene scene;
    scene.from_blender = true;
    const std::vector<glm::vec3> all = box_triangles(glm::vec3(1.0F), 1);
    for (size_t wall = 0; wall < 6; ++wall) {
        const auto first = all.begin() + static_cast<std::ptrdiff_t>(6 * wall);
        add_mesh_node(scene,
                      add_triangles(scene, {first, first + 6},
                                    add_diffuse(scene, glm::vec3(static_cast<float>(albedo[wall])))),
                      glm::dmat4(1.0));
    }
    add_light(scene, point(), glm::dmat4(1.0));
    const std::array<double, 3> expected = paths_in_a_box(albedo, 1000000);  // to 0.1 %
    for (const AvgPaths paths : {AvgPaths::roulette, AvgPaths::fixed}) {
        Settings settings = traced(64, 3, 16384);
        settings.avg_paths = paths;
        const Traced result = trace(scene, settings);
        for (size_t k = 0; k < 3; ++k) {
            // Of 16,384 random paths the sum's standard deviation would be 0.5 to 0.9 %; even ones have less.
            EXPECT_NEAR(result.flux_w(k).g / expected[k], 1.0, 0.008)
                << "bounce " << k + 1 << ", paths " << static_cast<int>(paths);
        }
    }
}

TEST_F(AvgTrace, LetsNoLightOutOfAClosedBox) {
    for (const int n : {1, 3, 60}) {  // the last are 43,200 triangles, a third of a voxel wide
        for (const double degrees : {0.0, 17.0, 45.0, 61.3}) {
            const glm::dmat4 turned = rotated(degrees, {0.3, 1.0, 0.2}, {0.4, -0.2, 0.1});
            const Traced result = trace(box(glm::vec3(0.9F), n, turned, point(), moved({0.6, 0.7, -0.8})),
                                        traced(n == 60 ? 64 : 32, 4, 2048));
            for (const auto& bounce : result.bounces) {
                EXPECT_EQ(dark(bounce), 0) << "rays that left the box, " << n << " squares, " << degrees;
            }
            EXPECT_LE(farthest(result, turned), 1.0) << n << " squares, turned by " << degrees;
        }
    }
}

TEST_F(AvgTrace, LetsNoLightThroughWallsThinnerThanAVoxel) {
    // A box within a box, its wall a tenth of a voxel thick, and a light in the inner one, or between them.
    for (const bool inside : {true, false}) {
        for (const double degrees : {0.0, 23.0}) {
            const glm::dmat4 turned = rotated(degrees, {1.0, 0.4, 0.3});
            scene::Scene scene;
            scene.from_blender = true;
            const int white = add_diffuse(scene, glm::vec3(0.9F));
            add_mesh_node(scene, add_triangles(scene, box_triangles(glm::vec3(2.0F), 1), white), turned);
            // 64 voxels along more than 4 m.
            add_mesh_node(scene, add_triangles(scene, box_triangles(glm::vec3(1.0F), 1), white), turned);
            add_mesh_node(scene, add_triangles(scene, box_triangles(glm::vec3(1.006F), 1), white), turned);
            add_light(scene, point(),
                      turned * moved(inside ? glm::dvec3(0.3, -0.4, 0.6) : glm::dvec3(1.5, 0.3, -1.2)));
            const Traced result = trace(scene, traced(64, 4, 2048));
            int wrong = 0;
            for (const auto& bounce : result.bounces) {
                EXPECT_EQ(dark(bounce), 0);
                for (const gpu::GpuVpl& vpl : bounce) {
                    const glm::dvec3 at =
                        glm::abs(glm::dvec3(glm::inverse(turned) * glm::dvec4(result.place(vpl), 1.0)));
                    const double out = std::max({at.x, at.y, at.z});
                    // Where the two sides of the wall meet, in the middle of it, is neither.
                    wrong += inside ? out > 1.003 : out < 1.003;
                }
            }
            EXPECT_EQ(wrong, 0) << "inside " << inside << ", turned by " << degrees;
        }
    }
}

TEST_F(AvgTrace, LightOutsideOfABoxIsNotInIt) {
    for (const scene::LightType type : {scene::LightType::point, scene::LightType::sun}) {
        scene::Scene scene =
            box(glm::vec3(0.9F), 5, rotated(31.0, {1.0, 0.4, 0.3}), point(), moved({1.7, 1.2, 1.9}));
        scene.lights[0] = light_of(type);
        const Traced result = trace(scene, traced(32, 3, 2048));
        int lit = 0;
        for (const auto& bounce : result.bounces) {
            for (const gpu::GpuVpl& vpl : bounce) {
                if (is_dark(vpl)) continue;
                const glm::dvec3 at = glm::abs(glm::dvec3(glm::inverse(rotated(31.0, {1.0, 0.4, 0.3})) *
                                                          glm::dvec4(result.place(vpl), 1.0)));
                ++lit;
                EXPECT_GE(std::max({at.x, at.y, at.z}), 1.0);
            }
        }
        EXPECT_GT(lit, 50);
    }
}

TEST_F(AvgTrace, LightsStandOnTheSurfacesTheyAreOf) {
    const glm::dmat4 turned = rotated(28.0, {0.2, 0.5, 1.0});
    const Traced result =
        trace(box(glm::vec3(0.7F), 1, turned, point(), moved({0.1, 0.2, 0.3})), traced(64, 3));
    for (const auto& bounce : result.bounces) {
        for (const gpu::GpuVpl& vpl : bounce) {
            const glm::dvec3 at = glm::dvec3(glm::inverse(turned) * glm::dvec4(result.place(vpl), 1.0));
            const glm::dvec3 a = glm::abs(at);
            const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
            EXPECT_NEAR(a[axis], 1.0, 1e-4) << "in front of the wall by less than a thousandth of a voxel";
            const glm::dvec3 n = glm::transpose(glm::dmat3(turned)) * glm::dvec3(glm::vec3(vpl.normal));
            EXPECT_NEAR(n[axis], at[axis] > 0.0 ? -1.0 : 1.0, 1e-3) << "and faces into the room";
        }
    }
}

TEST_F(AvgTrace, AFloorDoesNotStopRaysThatLeaveIt) {
    // Of what a floor below a roof sends up, all goes to the roof and the walls: nothing back to the floor
    // itself.
    const Traced slabs =
        trace(box(glm::vec3(0.9F), 1, rotated(12.0, {0.4, 1.0, 0.3}), point(), glm::dmat4(1.0)),
              traced(64, 2, 4096));
    const auto wall_of = [&](const gpu::GpuVpl& vpl) {
        const glm::dvec3 at =
            glm::dvec3(glm::inverse(rotated(12.0, {0.4, 1.0, 0.3})) * glm::dvec4(slabs.place(vpl), 1.0));
        const glm::dvec3 a = glm::abs(at);
        const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
        return 2 * axis + (at[axis] > 0.0 ? 1 : 0);
    };
    std::array<int, 6> walls{};
    for (const gpu::GpuVpl& vpl : slabs.bounces[1]) {
        ++walls[static_cast<size_t>(wall_of(vpl))];
    }
    for (const int count : walls) {
        EXPECT_NEAR(count / (4096.0 / 6.0), 1.0, 0.1) << "by symmetry";
    }
    // Paths are followed one by one, each from the light with its number.
    Settings settings = traced(64, 2, 4096);
    settings.avg_paths = AvgPaths::fixed;
    settings.interleave = 1;
    const Traced paths =
        trace(box(glm::vec3(0.9F), 1, rotated(12.0, {0.4, 1.0, 0.3}), point(), glm::dmat4(1.0)), settings);
    int same = 0;
    for (size_t i = 0; i < 4096; ++i) {
        same += wall_of(paths.bounces[0][i]) == wall_of(paths.bounces[1][i]) ? 1 : 0;
    }
    EXPECT_EQ(same, 0);
    settings.avg_hits = AvgHits::voxels;
    const Traced voxels =
        trace(box(glm::vec3(0.9F), 1, rotated(12.0, {0.4, 1.0, 0.3}), point(), glm::dmat4(1.0)), settings);
    int stuck = 0;
    for (size_t i = 0; i < 4096; ++i) {
        stuck += wall_of(voxels.bounces[0][i]) == wall_of(voxels.bounces[1][i]) ? 1 : 0;
    }
    EXPECT_GT(stuck, 400) << "as by the paper's rule, which this shows to be another";
}

TEST_F(AvgTrace, LightsShareRaysByTheirPower) {
    scene::Scene scene = box(glm::vec3(1.0F), 1, glm::dmat4(1.0), point(), moved({0.4, 0.0, 0.0}));
    scene.lights[0].color = glm::vec3(1.0F, 0.0F, 0.0F);
    scene::Light green = point();
    green.color = glm::vec3(0.0F, 1.0F, 0.0F);
    green.power_w = 20.0F;
    add_light(scene, green, moved({-0.4, 0.2, 0.0}));
    const Traced result = trace(scene, traced(32, 2));
    for (size_t k = 0; k < 2; ++k) {
        EXPECT_NEAR(result.flux_w(k).r / 100.0, 1.0, k == 0 ? 1e-4 : 0.01);
        EXPECT_NEAR(result.flux_w(k).g / 20.0, 1.0, k == 0 ? 1e-4 : 0.01);
    }
    int red = 0;
    for (const gpu::GpuVpl& vpl : result.bounces[0]) {
        red += vpl.intensity.r > 0.0F ? 1 : 0;
    }
    const double share = 21.26 / (21.26 + 0.2 * 71.52);
    EXPECT_NEAR(red / (1024.0 * share), 1.0, 0.01);
}

TEST_F(AvgTrace, HolesLetTheirPartOfTheLightThrough) {
    // A veil across the box stops 0.4 of what comes from the middle of one half.
    scene::Scene scene = box(glm::vec3(0.9F), 1, glm::dmat4(1.0), point(), moved({0.0, 0.0, 0.5}));
    scene::Material veil = scene.materials[0];
    veil.alpha_mode = scene::AlphaMode::blend;
    veil.base_color.a = 0.4F;
    scene.materials.push_back(veil);
    add_mesh_node(scene, add_square(scene, 2.0F, 1), glm::dmat4(1.0));
    const Traced result = trace(scene, traced(32, 1, 4096));
    int met = 0;
    int beyond = 0;
    for (const gpu::GpuVpl& vpl : result.bounces[0]) {
        const glm::dvec3 at = result.place(vpl);
        met += std::abs(at.z) < 1e-3 && std::max(std::abs(at.x), std::abs(at.y)) < 0.99 ? 1 : 0;
        beyond += at.z < -1e-3 ? 1 : 0;
    }
    EXPECT_NEAR(met / static_cast<double>(met + beyond), 0.4, 0.03);
}

TEST_F(AvgTrace, TheSameInputGivesTheSameBits) {
    const scene::Scene scene =
        box(glm::vec3(0.8F, 0.5F, 0.2F), 7, rotated(15.0, {0.2, 1.0, 0.1}), point(), moved({0.2, 0.1, -0.3}));
    const Traced first = trace(scene, traced(32, 3));
    const Traced again = trace(scene, traced(32, 3));
    for (size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(std::memcmp(first.bounces[k].data(), again.bounces[k].data(),
                              first.bounces[k].size() * sizeof(gpu::GpuVpl)),
                  0);
    }
}

TEST_F(AvgTrace, APictureOfAFurnaceIsAGeometricSeries) {
    for (const float albedo : {0.4F, 0.8F}) {
        scene::Scene scene = box(glm::vec3(albedo), 1, glm::dmat4(1.0), point(), glm::dmat4(1.0));
        CameraView camera = camera_from_above(2.0, 0.5);
        camera.camera.far_m = 10.0F;
        for (const bool from_lights : {false, true}) {
            double sum = 0.0;
            for (int bounces = 1; bounces <= 4; ++bounces) {
                Settings settings = bounced(48);
                settings.bounces = bounces;
                settings.vpls = settings.bounce_vpls = 1024;
                settings.vpl_sampling = from_lights ? VplSampling::avg : VplSampling::inverse_transform;
                settings.bounce_source = BounceSource::avg;
                sum += static_cast<double>(albedo) / pi * std::pow(static_cast<double>(albedo), bounces) *
                       100.0 / 24.0;
                // Lights stand at random, some of them near the edges of the wall that is looked at, where
                // bounding takes more than the near field's 1 % (tests/render/bounces_test.cpp).
                EXPECT_NEAR(draw(scene, camera, settings).mean() / sum, 1.0, 0.03)
                    << "albedo " << albedo << ", " << bounces << " bounces, from lights " << from_lights;
            }
        }
    }
}

TEST_F(AvgTrace, RaysOfEachKindOfLightHaveItsFlux) {
    // Solid angles of the profiles in closed form: a sphere; a cone with a hard edge; Lambert's hemisphere,
    // whose slats keep the power.
    scene::Light spot = light_of(scene::LightType::spot);
    spot.profile = scene::SpotProfile::cycles_4;
    spot.blend = 0.0F;
    scene::Light area = light_of(scene::LightType::area);
    scene::Light box = area;
    box.spread_rad = 0.6F;
    const scene::Bounds bounds{glm::dvec3(-1.0), glm::dvec3(1.0)};
    const gpu::RenderSpace space = gpu::RenderSpace::around(bounds);
    scene::LightInstance at{};
    at.world_from_light = moved({0.0, 0.0, 0.5});
    const auto setup = [&](const scene::Light& light) {
        return set_up_light(at, light, bounds, space, 64, 64);
    };
    const double scale = space.scale * space.scale;
    const double cone = 2.0 * pi * (1.0 - std::cos(0.6));
    EXPECT_NEAR(avg_flux(setup(point())).g / (100.0 * scale), 1.0, 1e-5);
    EXPECT_NEAR(avg_flux(setup(spot)).g / (100.0 / (4.0 * pi) * cone * scale), 1.0, 1e-3);
    EXPECT_NEAR(avg_flux(setup(area)).g / (25.0 * pi * scale), 1.0, 1e-4);
    EXPECT_NEAR(avg_flux(setup(box)).g / (25.0 * pi * scale), 1.0, 1e-3);
    for (const scene::Light& light : {point(), spot, area, box, light_of(scene::LightType::sun)}) {
        const LightSetup of = setup(light);
        const std::vector<AvgRayLight> lights = {{of, {}}};
        const IsmLayout layout = ism_layout(traced(64, 1, 1000), 1, 0);
        glm::dvec3 sum(0.0);
        double along = 0.0;
        for (const gpu::GpuAvgRay& ray : avg_rays(lights, layout)) {
            sum += glm::dvec3(glm::vec3(ray.flux));
            EXPECT_NEAR(glm::length(glm::vec3(ray.direction)), 1.0F, 1e-5F);
            along = std::max(along, std::acos(std::min(1.0, glm::dot(glm::dvec3(glm::vec3(ray.direction)),
                                                                     glm::dvec3(glm::vec3(of.gpu.axis))))));
        }
        EXPECT_NEAR(sum.g / avg_flux(of).g, 1.0, 1e-5);
        if (light.type == scene::LightType::spot) {
            EXPECT_LE(along, 0.6 + 1e-4) << "within the cone";
            EXPECT_GT(along, 0.57);
        }
        if (light.spread_rad == 0.6F && light.type == scene::LightType::area) {
            EXPECT_LE(along, 0.3 + 1e-3) << "between the slats";
        }
    }
}

TEST_F(AvgTrace, AGridThatBuffersDoNotHoldIsRefused) {
    Settings settings = traced(256);
    settings.visibility = Visibility::none;
    settings.world_vpls = settings.emitter_vpls = 0;
    gl::DeviceLimits limits;
    EXPECT_EQ(limits_refusal(settings, limits), "");
    limits.storage_block_bytes = 16 << 20;
    EXPECT_NE(limits_refusal(settings, limits).find("--avg-size is 256"), std::string::npos);
    settings.avg_size = 128;
    EXPECT_EQ(limits_refusal(settings, limits), "");
    settings.avg_size = 31;
    EXPECT_NE(settings_refusal(settings).find("--avg-size is 31"), std::string::npos);
}

TEST_F(AvgTrace, RunsItsPassesAndNoMore) {
    scene::Scene scene = corner_scene();
    add_wall_spot(scene);
    scene.lights[0].name = "Spot";
    Settings settings = bounced(32);
    settings.interleave = 1;
    settings.near_field = false;
    settings.visibility = Visibility::none;
    settings.bounces = 2;
    settings.bounce_source = BounceSource::avg;
    using Passes = std::vector<std::string>;
    EXPECT_EQ(
        draw(scene, floor_camera(), settings).report.executed,
        (Passes{"gbuffer", "rsm: Spot", "avg cells", "avg voxels", "avg slabs", "vpl importance", "vpls",
                "avg flux", "avg trace, next bounce", "vpl spacing", "vpl gather", "composite"}));
    settings.bounces = 1;
    const FrameReport one = draw(scene, floor_camera(), settings).report;
    EXPECT_EQ(one.executed,
              (Passes{"gbuffer", "rsm: Spot", "vpl importance", "vpls", "vpl gather", "composite"}));
    EXPECT_TRUE(std::any_of(one.left_out.begin(), one.left_out.end(), [](const LeftOut& out) {
        return out.pass == "avg cells" && !out.reason.empty();
    }));
    settings.vpl_sampling = VplSampling::avg;
    EXPECT_EQ(draw(scene, floor_camera(), settings).report.executed,
              (Passes{"gbuffer", "avg cells", "avg voxels", "avg slabs", "avg trace", "vpl spacing",
                      "vpl gather", "composite"}));
    settings.show = Show::avg;
    EXPECT_EQ(draw(scene, floor_camera(), settings).report.executed,
              (Passes{"avg cells", "avg voxels", "avg slabs", "avg view"}));
}

}  // namespace
}  // namespace bounce::test
