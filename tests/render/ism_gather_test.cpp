// SPDX-License-Identifier: Apache-2.0
//
// Bounced light by virtual point lights as a picture: against the sum over every texel of the reflective
// shadow map, at every interleave, at every power, twice.
#include <numeric>

#include "ism_fixture.h"

namespace bounce::test {
namespace {

class IsmGather : public ::testing::Test {
  protected:
    void SetUp() override { require_context(); }

    static scene::Scene lit_corner() {
        scene::Scene scene = corner_scene();
        add_wall_spot(scene);
        return scene;
    }
    static Settings with(int interleave, int vpls = 256) {
        Settings settings = bounced(48);
        settings.interleave = interleave;
        settings.vpls = vpls;
        return settings;
    }
    struct Difference {
        double mean, absolute, worst;  // over the reference's mean; worst of the inner pixels' relative ones
    };
    static Difference compare(const Rendered& got, const Rendered& reference) {
        Difference d{got.mean() / reference.mean() - 1.0, 0.0, 0.0};
        const int n = got.image.width;
        for (int y = 0; y < n; ++y) {
            for (int x = 0; x < n; ++x) {
                for (int c = 0; c < 3; ++c) {
                    const double off = std::abs(got.at(x, y)[c] - reference.at(x, y)[c]);
                    d.absolute += off / reference.mean() / (3.0 * n * n);
                    if (x >= n / 6 && x < n - 4 && y >= 4 && y < n - 4) {
                        d.worst = std::max(d.worst, off / reference.at(x, y)[c]);
                    }
                }
            }
        }
        return d;
    }
    // A floor under a ceiling that a spot lights: light on the floor is smooth.
    static scene::Scene lit_ceiling() {
        scene::Scene scene;
        scene.from_blender = true;
        const int square = add_square(scene, 4.0F, add_diffuse(scene, glm::vec3(0.8F)));
        add_mesh_node(scene, square, glm::dmat4(1.0));
        add_mesh_node(scene, square, rotated(180.0, {1.0, 0.0, 0.0}, {0.0, 0.0, 3.0}));
        add_light(scene, light_of(scene::LightType::spot), rotated(160.0, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}));
        return scene;
    }
    static CameraView below_ceiling() { return camera_from_above(4.0, 2.5); }

    // How much of the pattern of n x n pixels is in a picture: how far the means of its pixels' ratios to a
    // reference are apart, away from the edges, where the blur has not all of its neighbours.
    static double pattern(const Rendered& got, const Rendered& reference, int n) {
        std::vector<double> sums(static_cast<size_t>(n * n), 0.0);
        std::vector<double> counts(sums.size(), 0.0);
        for (int y = n; y < got.image.height - n; ++y) {
            for (int x = n; x < got.image.width - n; ++x) {
                const auto k = static_cast<size_t>(y % n * n + x % n);
                sums[k] += got.at(x, y).x / reference.at(x, y).x;
                counts[k] += 1.0;
            }
        }
        double low = 1e30;
        double high = 0.0;
        for (size_t k = 0; k < sums.size(); ++k) {
            low = std::min(low, sums[k] / counts[k]);
            high = std::max(high, sums[k] / counts[k]);
        }
        return high - low;
    }
};

TEST_F(IsmGather, IsTheFullSumWhereNothingIsHidden) {
    for (const scene::LightType type :
         {scene::LightType::spot, scene::LightType::sun, scene::LightType::point, scene::LightType::area}) {
        scene::Scene scene = corner_scene();
        add_light(scene, light_of(type),
                  type == scene::LightType::point || type == scene::LightType::area
                      ? moved({0.3, 0.4, 1.5})
                      : rotated(55.0, {0.0, 1.0, 0.0}, {1.0, 0.2, 2.0}));
        Settings full = with(1);
        full.technique = Technique::rsm;
        full.rsm_full_sum = true;
        full.rsm_size = 128;
        const Rendered reference = draw(scene, floor_camera(), full);
        Settings settings = with(1, 4096);
        settings.rsm_size = 128;
        const Difference fine = compare(draw(scene, floor_camera(), settings), reference);
        // The area light shines down: the wall, which alone lights the floor, has one light in twenty.
        const bool few = type == scene::LightType::area;
        EXPECT_LT(std::abs(fine.mean), few ? 0.04 : 0.015) << static_cast<int>(type);
        EXPECT_LT(fine.absolute, few ? 0.12 : 0.05) << static_cast<int>(type);
        settings = with(4, 256);
        settings.rsm_size = 128;
        const Difference coarse = compare(draw(scene, floor_camera(), settings), reference);
        EXPECT_LT(std::abs(coarse.mean), few ? 0.3 : 0.08) << static_cast<int>(type);
        EXPECT_LT(coarse.absolute, few ? 0.3 : 0.09) << static_cast<int>(type);
    }
}

TEST_F(IsmGather, EveryInterleaveHasTheSameMean) {
    // The same lights, shared out: the means differ by how subsets are weighed at the picture's edges.
    const scene::Scene scene = lit_ceiling();
    Settings settings = with(1, 1024);
    settings.width = settings.height = 64;
    const Rendered reference = draw(scene, below_ceiling(), settings);
    for (const int n : {2, 4, 8, 16}) {
        settings.interleave = n;
        const Rendered r = draw(scene, below_ceiling(), settings);
        // A sum over n x n pixels loses what lies beyond the picture's edge and bends what is not linear.
        EXPECT_NEAR(r.mean() / reference.mean(), 1.0, n <= 4 ? 1e-3 : n == 8 ? 4e-3 : 0.015) << n;
        // Lights of different subsets differ by a tenth and more; of that nothing must be seen.
        EXPECT_LT(pattern(r, reference, n), n == 2 ? 5e-4 : n == 4 ? 3e-3 : n == 8 ? 0.015 : 0.08) << n;
    }
}

TEST_F(IsmGather, PowerScalesThePicture) {
    for (const scene::LightType type : {scene::LightType::spot, scene::LightType::sun}) {
        scene::Scene scene = corner_scene();
        add_light(scene, light_of(type), rotated(55.0, {0.0, 1.0, 0.0}, {1.0, 0.2, 2.0}));
        scene.lights[0].power_w = 1.0F;
        scene.lights[0].irradiance_w_m2 = 1.0F;
        Settings settings = with(4);
        settings.bounces = 2;
        const Rendered base = draw(scene, floor_camera(), settings);
        for (const float power : {1e-6F, 1e-3F, 1e3F, 1e6F}) {
            scene.lights[0].power_w = scene.lights[0].irradiance_w_m2 = power;
            const Rendered r = draw(scene, floor_camera(), settings);
            double worst = 0.0;
            for (size_t i = 0; i < r.image.rgb.size(); ++i) {
                worst = std::max(worst,
                                 std::abs(static_cast<double>(r.image.rgb[i]) / static_cast<double>(power) /
                                              static_cast<double>(base.image.rgb[i]) -
                                          1.0));
            }
            EXPECT_NEAR(r.mean() / static_cast<double>(power) / base.mean(), 1.0, 1e-4) << power;
            // Half floats in between, several times: 11 bits each.
            EXPECT_LT(worst, 0.003) << power;
        }
    }
}

TEST_F(IsmGather, SameFrameSameBits) {
    scene::Scene scene = lit_corner();
    add_mesh_node(scene, add_ball(scene, add_diffuse(scene), 0.25F), moved({-1.0, 0.0, 0.75}));
    for (const Splat splat : {Splat::disks, Splat::compute, Splat::points}) {
        Settings settings = with(4);
        settings.splat = splat;
        settings.bounces = 2;
        const scene::Pose pose = scene::evaluate_pose(scene, 0.0);
        Renderer renderer(scene);
        renderer.render(pose, floor_camera(), settings);
        const Image first = renderer.read_color();
        renderer.render(pose, floor_camera(), settings);
        EXPECT_EQ(first.rgb, renderer.read_color().rgb) << "the same renderer";
        EXPECT_EQ(first.rgb, draw(scene, floor_camera(), settings).image.rgb) << "another one";
        EXPECT_GT(std::accumulate(first.rgb.begin(), first.rgb.end(), 0.0F), 0.0F);
    }
}

TEST_F(IsmGather, TheBlurKeepsEdges) {
    // Strips high above the floor, half a pixel to three pixels wide, that stand above all that is lit: what
    // is seen of them has no light at all, and the floor beside them as much as without them.
    scene::Scene scene = lit_corner();
    const int material = add_diffuse(scene, glm::vec3(0.8F));
    for (int i = 0; i < 5; ++i) {
        add_mesh_node(scene, add_square(scene, 1.0F, material),
                      moved({-1.25 + 0.7 * i, 0.0, 2.5}) *
                          glm::scale(glm::dmat4(1.0), glm::dvec3(0.05 + 0.05 * i, 4.0, 1.0)));
    }
    Settings settings = with(4);
    settings.visibility = Visibility::none;
    settings.near_field = false;  // of which without interleaving a pixel has a sixteenth of the samples
    Settings exact = settings;
    exact.interleave = 1;
    const Rendered r = draw(scene, floor_camera(), settings);
    const Rendered e = draw(scene, floor_camera(), exact);
    int strips = 0;
    for (int y = 4; y < 44; ++y) {
        for (int x = 8; x < 44; ++x) {
            if (e.at(x, y).x < 1e-5) {
                ++strips;
                EXPECT_LT(r.at(x, y).x, 1e-5) << x << ' ' << y;
            } else {
                EXPECT_NEAR(r.at(x, y).x / e.at(x, y).x, 1.0, 0.15) << x << ' ' << y;
            }
        }
    }
    EXPECT_GT(strips, 200);
}

}  // namespace
}  // namespace bounce::test
