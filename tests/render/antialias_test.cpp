// SPDX-License-Identifier: Apache-2.0
//
// Outlines against the same picture drawn with many more pixels and filtered here.
#include <algorithm>

#include "render_fixture.h"
#include "renderer/sampled_picture.h"

namespace bounce::test {
namespace {

class Antialias : public ::testing::Test {
  protected:
    void SetUp() override { require_context(); }
};

constexpr int k_side = 48;
constexpr int k_finer = 8;

// Cycles' pixel filter: Blackman-Harris over three pixels.
double window(double distance) {
    const double t = 2.0 * pi * (distance / 3.0 + 0.5);
    return std::abs(distance) < 1.5
               ? 0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2.0 * t) - 0.01168 * std::cos(3.0 * t)
               : 0.0;
}

// The red channel of a picture k_finer times as wide and high, filtered.
double filtered(const Image& fine, int x, int y) {
    double sum = 0.0;
    double weights = 0.0;
    const int side = k_side * k_finer;
    for (int j = std::max((y - 1) * k_finer, 0); j < std::min((y + 2) * k_finer, side); ++j) {
        for (int i = std::max((x - 1) * k_finer, 0); i < std::min((x + 2) * k_finer, side); ++i) {
            const double weight =
                window((i + 0.5) / k_finer - x - 0.5) * window((j + 0.5) / k_finer - y - 0.5);
            weights += weight;
            sum += weight * static_cast<double>(fine.rgb[fine.offset(i, j)]);
        }
    }
    return sum / weights;
}

struct Errors {
    double smooth_rms = 0.0;
    double rough_rms = 0.0;  // without antialiasing
    double worst = 0.0;
    double bias = 0.0;
};

Errors compare_with_filtered(const scene::Scene& scene, const CameraView& camera) {
    Settings settings;
    settings.technique = Technique::direct;
    settings.width = settings.height = k_side;
    const Rendered smooth = draw(scene, camera, settings);
    settings.antialias = false;
    const Rendered rough = draw(scene, camera, settings);
    settings.width = settings.height = k_side * k_finer;
    const Rendered fine = draw(scene, camera, settings);
    Errors errors;
    double sum = 0.0;
    double expected_sum = 0.0;
    for (int y = 0; y < k_side; ++y) {
        for (int x = 0; x < k_side; ++x) {
            const double expected = filtered(fine.image, x, y);
            const double off = smooth.at(x, y).x - expected;
            errors.smooth_rms += off * off / (k_side * k_side);
            errors.rough_rms += std::pow(rough.at(x, y).x - expected, 2) / (k_side * k_side);
            errors.worst = std::max(errors.worst, std::abs(off));
            sum += smooth.at(x, y).x;
            expected_sum += expected;
        }
    }
    errors.smooth_rms = std::sqrt(errors.smooth_rms);
    errors.rough_rms = std::sqrt(errors.rough_rms);
    errors.bias = sum / expected_sum - 1.0;
    return errors;
}

glm::dmat4 turned(double degrees, double height) {
    return glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, height)), degrees * pi / 180.0,
                       glm::dvec3(0.0, 0.0, 1.0));
}

scene::Scene lit_from_above() {
    scene::Scene scene;
    scene.from_blender = true;
    scene::Light sun;
    sun.type = scene::LightType::sun;
    sun.irradiance_w_m2 = static_cast<float>(pi);
    add_light(scene, sun, glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, 5.0)));
    return scene;
}

// Four samples a pixel know coverage to an eighth of a step, where the filter mixes in the neighbours'
// samples: a fifth of a step at worst (the tip of a corner). One sample a pixel is wrong by 0.29 of a step in
// the mean over an outline's pixels, four by about a third of that.
TEST_F(Antialias, AnOutlineBeforeNothingIsFilteredAsByCycles) {
    scene::Scene scene = lit_from_above();
    add_mesh_node(scene, add_square(scene, 2.0F, add_diffuse(scene)), turned(13.0, 0.0));
    const Errors errors = compare_with_filtered(scene, camera_from_above(4.0, 10.0));
    EXPECT_LT(errors.smooth_rms, 0.35 * errors.rough_rms);
    EXPECT_LT(errors.worst, 0.2);
    EXPECT_NEAR(errors.bias, 0.0, 0.003);
    EXPECT_GT(errors.rough_rms, 0.02) << "there is something to smooth";
}

TEST_F(Antialias, AnOutlineBeforeAnotherSurfaceAsWell) {
    scene::Scene scene = lit_from_above();
    scene.lights[0].cast_shadow = false;
    add_mesh_node(scene, add_square(scene, 6.0F, add_diffuse(scene, glm::vec3(0.1F))), glm::dmat4(1.0));
    add_mesh_node(scene, add_square(scene, 2.0F, add_diffuse(scene)), turned(28.0, 1.0));
    const Errors errors = compare_with_filtered(scene, camera_from_above(4.0, 10.0));
    EXPECT_LT(errors.smooth_rms, 0.35 * errors.rough_rms);
    EXPECT_LT(errors.worst, 0.2);
    EXPECT_NEAR(errors.bias, 0.0, 0.003);
}

TEST_F(Antialias, TwoWallsOfARoofMeetSmoothly) {
    // Seen from above depth has no step at the ridge: only the planes tell the sides apart.
    scene::Scene scene = lit_from_above();
    scene.lights[0].cast_shadow = false;
    for (const double side : {-1.0, 1.0}) {
        const int mesh = add_square(scene, 4.0F, add_diffuse(scene, glm::vec3(side < 0.0 ? 0.9F : 0.1F)));
        // Half of a square, hinged at the ridge, falls off to its side by 45 degrees; the ridge runs askew.
        const glm::dmat4 tilt = glm::rotate(glm::dmat4(1.0), side * pi / 4.0, glm::dvec3(0.0, 1.0, 0.0));
        add_mesh_node(
            scene, mesh,
            turned(7.0, 3.0) * tilt * glm::translate(glm::dmat4(1.0), glm::dvec3(side * 2.0, 0.0, 0.0)));
    }
    const Errors errors = compare_with_filtered(scene, camera_from_above(2.5, 10.0));
    EXPECT_LT(errors.smooth_rms, 0.35 * errors.rough_rms);
    EXPECT_LT(errors.worst, 0.25);
    EXPECT_NEAR(errors.bias, 0.0, 0.005);
}

TEST_F(Antialias, AShadowsOutlineIsFilteredToo) {
    scene::Scene scene = lit_from_above();
    scene.nodes.back().matrix = glm::rotate(turned(0.0, 5.0), 0.5, glm::dvec3(0.0, 1.0, 0.0));
    add_mesh_node(scene, add_square(scene, 6.0F, add_diffuse(scene)), glm::dmat4(1.0));
    add_mesh_node(scene, add_square(scene, 1.0F, add_diffuse(scene, glm::vec3(0.0F))), turned(20.0, 1.0));
    const Errors errors = compare_with_filtered(scene, camera_from_above(4.0, 10.0));
    EXPECT_LT(errors.smooth_rms, 0.35 * errors.rough_rms);
    EXPECT_LT(errors.worst, 0.3);
    EXPECT_NEAR(errors.bias, 0.0, 0.004);
}

// The mean of 64 frames by the same filter: noise of the samples alone is left, and no bias at all.
TEST_F(Antialias, ManySamplesAreFilteredAsByCycles) {
    scene::Scene scene = lit_from_above();
    scene.lights[0].cast_shadow = false;
    add_mesh_node(scene, add_square(scene, 6.0F, add_diffuse(scene, glm::vec3(0.1F))), glm::dmat4(1.0));
    add_mesh_node(scene, add_square(scene, 2.0F, add_diffuse(scene)), turned(28.0, 1.0));
    const CameraView camera = camera_from_above(4.0, 10.0);
    Settings settings;
    settings.technique = Technique::direct;
    settings.antialias = false;
    settings.width = settings.height = k_side * k_finer;
    const Rendered fine = draw(scene, camera, settings);
    settings.width = settings.height = k_side;
    const Image rough = draw(scene, camera, settings).image;
    const auto rms = [&](const Image& image) {
        double sum = 0.0;
        for (int y = 2; y < k_side - 2; ++y) {
            for (int x = 2; x < k_side - 2; ++x) {
                sum += std::pow(
                    static_cast<double>(image.rgb[image.offset(x, y)]) - filtered(fine.image, x, y), 2);
            }
        }
        return std::sqrt(sum) / (k_side - 4);
    };
    const auto samples = [&](int count) {
        Renderer renderer(scene);
        const scene::Pose pose = scene::evaluate_pose(scene, 0.0);
        PictureMean mean;
        settings.samples = count;
        const FrameReport report =
            render_samples(renderer, {pose, camera}, settings, gl::TimingMode::off, mean);
        EXPECT_FALSE(report.executed.empty());
        return mean.mean();
    };
    EXPECT_EQ(samples(1).rgb, rough.rgb) << "one sample is the frame as it is";
    EXPECT_LT(rms(samples(4)), 0.6 * rms(rough));
    EXPECT_LT(rms(samples(64)), 0.08 * rms(rough));  // 0.067 here; noise of one in sixty-four would be 0.125
}

TEST_F(Antialias, WhereOneSurfaceFillsThePictureNothingChanges) {
    scene::Scene scene = lit_from_above();
    add_mesh_node(scene, add_square(scene, 20.0F, add_diffuse(scene, glm::vec3(0.3F))), glm::dmat4(1.0));
    Settings settings;
    settings.technique = Technique::direct;
    settings.width = settings.height = k_side;
    const Rendered smooth = draw(scene, camera_from_above(4.0, 10.0), settings);
    settings.antialias = false;
    EXPECT_EQ(smooth.image.rgb, draw(scene, camera_from_above(4.0, 10.0), settings).image.rgb);
}

}  // namespace
}  // namespace bounce::test
