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
        out.vpls = out.bounce_vpls = out.emitter_vpls = 256;
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

TEST_F(FurnaceRoom, OfWallsThatShineByBounces) {
    // One wall of a cube is all of them. Bounding 1/d^2 takes up to 4 % along the edges with 256 lights, and
    // adds nothing (docs/invariance.md).
    for (const int bounces : {0, 1, 2}) {
        const Furnace furnace{FurnaceShape::cube, FurnaceLight::emission, 0.5F};
        const double ratio = mean(furnace, bounces, 1) / bench::furnace_radiance(furnace, bounces);
        EXPECT_GT(ratio, 0.96) << bounces << " bounces";
        EXPECT_LT(ratio, 1.005) << bounces << " bounces";
    }
}

TEST_F(FurnaceRoom, OfALampBesideTheMiddle) {
    const Furnace furnace{FurnaceShape::cube, FurnaceLight::point, 0.99F};
    // 16 x 16 pixels of a wall have its mean of the lamp's own light within 1 %; the rest is the lights'.
    EXPECT_NEAR(mean(furnace, 2, 6) / bench::furnace_radiance(furnace, 2), 1.0, 0.015);
}

TEST_F(FurnaceRoom, RoundOneIsLitEvenly) {
    // The lamp's own light is not even; what walls send on is, each bounce of it.
    const Furnace lamp{FurnaceShape::sphere, FurnaceLight::point, 0.8F};
    const scene::Scene lit = bench::make_furnace(lamp);
    Settings of = settings(2);
    of.show = Show::indirect;
    const Rendered bounced = draw(lit, bench::furnace_cameras(lamp.shape).front(), of);
    const double expected = bench::furnace_radiance(lamp, 2) - bench::furnace_radiance(lamp, 0);
    EXPECT_NEAR(bounced.mean() / expected, 1.0, 0.01);
    for (const float value : bounced.image.rgb) {
        EXPECT_NEAR(static_cast<double>(value) / expected, 1.0, 0.1) << "noise of single pixels";
    }
    const Furnace walls{FurnaceShape::sphere, FurnaceLight::emission, 0.8F};
    EXPECT_NEAR(mean(walls, 2, 1) / bench::furnace_radiance(walls, 2), 1.0, 0.01);
}

}  // namespace
}  // namespace bounce::test
