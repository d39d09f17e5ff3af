// SPDX-License-Identifier: Apache-2.0
//
// Closed rooms whose light is known exactly (bench/furnace_room.h). bounces_test.cpp has a lamp in the middle
// of a cube; here walls shine themselves, the lamp stands aside, and the room is round. bench furnace
// measures more.
#include "bench/furnace_room.h"
#include "render_fixture.h"

namespace bounce::test {
namespace {

using bench::Furnace;
using bench::FurnaceLight;
using bench::FurnaceShape;

class FurnaceRoom : public ::testing::Test {
  protected:
    void SetUp() override { require_context(); }

    static Settings settings(int bounces) {
        Settings out;
        out.width = out.height = 16;
        out.technique = bounces > 0 ? Technique::ism : Technique::direct;
        out.bounces = std::max(bounces, 1);
        out.vpls = out.bounce_vpls = out.emitter_vpls = 1024;
        out.visibility = Visibility::none;  // a convex room hides nothing
        return out;
    }
    static double mean(const Furnace& furnace, int bounces, size_t views) {
        const scene::Scene scene = bench::make_furnace(furnace);
        const std::vector<CameraView> cameras = bench::furnace_cameras(furnace.shape);
        double sum = 0.0;
        for (size_t i = 0; i < views; ++i) {
            sum += draw(scene, cameras[i], settings(bounces)).mean();
        }
        return sum / static_cast<double>(views);
    }
};

// 1 %: what bounding 1/d^2 takes along the edges, with 1,024 lights (docs/invariance.md).
constexpr double k_tolerance = 0.01;

TEST_F(FurnaceRoom, OfWallsThatShineByBounces) {
    // One wall of a cube is all of them.
    for (const int bounces : {0, 1, 2, 4}) {
        const Furnace furnace{FurnaceShape::cube, FurnaceLight::emission, 0.5F};
        EXPECT_NEAR(mean(furnace, bounces, 1) / bench::furnace_radiance(furnace, bounces), 1.0, k_tolerance)
            << bounces << " bounces";
    }
}

TEST_F(FurnaceRoom, OfALampBesideTheMiddle) {
    for (const float albedo : {0.5F, 0.99F}) {
        const Furnace furnace{FurnaceShape::cube, FurnaceLight::point, albedo};
        EXPECT_NEAR(mean(furnace, 2, 6) / bench::furnace_radiance(furnace, 2), 1.0, k_tolerance)
            << "albedo " << albedo;
    }
}

TEST_F(FurnaceRoom, RoundOneIsLitEvenly) {
    for (const FurnaceLight light : {FurnaceLight::emission, FurnaceLight::point}) {
        const Furnace furnace{FurnaceShape::sphere, light, 0.8F};
        const scene::Scene scene = bench::make_furnace(furnace);
        Settings of = settings(2);
        of.show = Show::indirect;
        const Rendered picture = draw(scene, bench::furnace_cameras(furnace.shape).front(), of);
        // The lamp's own light is not even; what walls send on is, each bounce of it.
        const double direct =
            light == FurnaceLight::point ? bench::furnace_radiance(furnace, 0) : bench::k_furnace_emission;
        const double expected = bench::furnace_radiance(furnace, 2) - direct;
        EXPECT_NEAR(picture.mean() / expected, 1.0, k_tolerance);
        for (const float value : picture.image.rgb) {
            EXPECT_NEAR(static_cast<double>(value) / expected, 1.0, 0.06) << "noise of single pixels";
        }
    }
}

}  // namespace
}  // namespace bounce::test
