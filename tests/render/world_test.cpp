// SPDX-License-Identifier: Apache-2.0
//
// The world's light: what it gives where nothing is in its way, what hides it, and its bounces.
#include <gmock/gmock.h>

#include "ism_fixture.h"

namespace bounce::test {
namespace {

using ::testing::Contains;
using ::testing::Not;

class WorldLight : public ::testing::Test {
  protected:
    static constexpr int size = 32;
    void SetUp() override { require_context(); }

    static scene::Scene under_world(float radiance) {
        scene::Scene scene;
        scene.from_blender = true;
        scene.world = {glm::vec3(1.0F), radiance};
        return scene;
    }
    static Settings lit_directly(int lights) {
        Settings settings;
        settings.width = settings.height = size;
        settings.technique = Technique::direct;
        settings.world_vpls = lights;
        settings.antialias = false;
        return settings;
    }
    // Mean of the middle, away from the picture's edges, where the blur averages fewer lights.
    static double middle(const Rendered& r) {
        double sum = 0.0;
        int count = 0;
        for (int y = size / 4; y < 3 * size / 4; ++y) {
            for (int x = size / 4; x < 3 * size / 4; ++x) {
                sum += r.at(x, y).x;
                ++count;
            }
        }
        return sum / count;
    }
    // Six squares of side 2 around the origin without a thickness, their parts the first `walls` of floor,
    // sides, lid.
    static void add_walls(scene::Scene& scene, int walls, float albedo) {
        const int square = add_square(scene, 2.0F, add_diffuse(scene, glm::vec3(albedo)));
        const double turns[6][4] = {{0, 1, 0, 0},  {90, 1, 0, 0},  {-90, 1, 0, 0},
                                    {90, 0, 1, 0}, {-90, 0, 1, 0}, {180, 1, 0, 0}};
        for (int i = 0; i < walls; ++i) {
            add_mesh_node(
                scene, square,
                rotated(turns[i][0], {turns[i][1], turns[i][2], turns[i][3]}) * moved({0.0, 0.0, -1.0}));
        }
    }
    static CameraView camera_inside() {
        CameraView camera = camera_from_above(1.9, 0.5);
        camera.camera.far_m = 10.0F;
        return camera;
    }
};

TEST_F(WorldLight, AnOpenPlaneShowsAlbedoTimesRadiance) {
    // 256 directions as even as these leave a plane's irradiance half a per cent off at most, whichever way
    // it faces.
    for (const double tilt : {0.0, 25.0, 60.0}) {
        scene::Scene scene = under_world(3.0F);
        const glm::dmat4 turn = rotated(tilt, glm::normalize(glm::dvec3(1.0, 0.4, 0.2)));
        add_mesh_node(scene, add_square(scene, 20.0F, add_diffuse(scene, glm::vec3(0.5F))), turn);
        CameraView camera = camera_from_above(4.0, 50.0);
        camera.world_from_camera = turn * camera.world_from_camera;
        const Rendered r = draw(scene, camera, lit_directly(256));
        EXPECT_THAT(r.report.executed, Contains("ism disks"));
        EXPECT_NEAR(middle(r) / 1.5, 1.0, 0.01) << tilt;
    }
}

TEST_F(WorldLight, AWhiteBallShowsTheWorld) {
    // Convex, so nothing is hidden and nothing comes from itself; its map's disks must not hide it from the
    // light. 2 % is what a thousand flat triangles with smooth normals and the disks' planes take along their
    // edges.
    scene::Scene scene = under_world(1.0F);
    add_mesh_node(scene, add_ball(scene, add_diffuse(scene), 1.0F), glm::dmat4(1.0));
    const Rendered r = draw(scene, camera_from_above(1.6, 5.0), lit_directly(256));
    EXPECT_NEAR(middle(r), 1.0, 0.02);
}

TEST_F(WorldLight, AWallHidesItsPartOfTheDome) {
    // A black wall of height h that goes on for ever to both sides takes (1 - d / sqrt(d^2 + h^2)) / 2 of a
    // ground's irradiance at a distance d from its foot. This one goes on for 20 heights; texels of its maps
    // are half a metre wide, which is what its shadow's edge may be off by: 2 % of the irradiance.
    scene::Scene scene = under_world(1.0F);
    constexpr double height = 3.0;
    add_mesh_node(scene, add_square(scene, 200.0F, add_diffuse(scene)), glm::dmat4(1.0));
    add_mesh_node(scene, add_box(scene, glm::vec3(0.2F, 30.0F, 1.5F), add_diffuse(scene, glm::vec3(0.0F))),
                  moved({0.0, 0.0, 0.5 * height}));
    for (const double d : {0.5, 1.0, 3.0, 8.0}) {
        CameraView camera = camera_from_above(0.5, 20.0);
        camera.world_from_camera = moved({0.2 + d, 0.0, 0.0}) * camera.world_from_camera;
        const double found = middle(draw(scene, camera, lit_directly(1024)));
        EXPECT_NEAR(found, 1.0 - 0.5 * (1.0 - d / std::hypot(d, height)), 0.02) << d;
    }
}

TEST_F(WorldLight, AFarGroundDoesNotCoarsenTheMaps) {
    // A ground 3,000 times as wide as what stands on it: the post's shadow is as it is on a small one.
    const auto darkest = [](float ground) {
        scene::Scene scene = under_world(1.0F);
        add_mesh_node(scene, add_square(scene, ground, add_diffuse(scene)), glm::dmat4(1.0));
        add_mesh_node(scene, add_box(scene, glm::vec3(0.5F), add_diffuse(scene, glm::vec3(0.0F))),
                      moved({0.0, 0.0, 0.5}));
        CameraView camera = camera_from_above(0.1, 20.0);
        camera.world_from_camera = moved({0.6, 0.0, 0.0}) * camera.world_from_camera;
        return middle(draw(scene, camera, lit_directly(256)));
    };
    const double small = darkest(4.0F);
    EXPECT_LT(small, 0.8) << "the box hides a good part of the sky from its foot";
    EXPECT_NEAR(darkest(3000.0F), small, 0.02) << "a texel's width of the shadow, at most";
}

TEST_F(WorldLight, PointsFarOffTheMapsAreNotDrawn) {
    // The maps show what stands on the ground; where that is no large triangle but points, most of these lie
    // beside the maps, many along both axes. Drawn into other texels they would hide anything,
    // or end the program. 10 %: points metres apart hide some of what stands between them.
    scene::Scene scene = under_world(1.0F);
    add_mesh_node(scene, add_square(scene, 200.0F, add_diffuse(scene)), glm::dmat4(1.0));
    add_mesh_node(scene, add_box(scene, glm::vec3(0.5F), add_diffuse(scene, glm::vec3(0.2F))),
                  moved({0.0, 0.0, 0.25}));
    Settings settings = lit_directly(256);
    const double triangles = middle(draw(scene, camera_from_above(4.0, 20.0), settings));
    settings.large_triangles = false;
    settings.drop_hull = false;
    const Rendered points = draw(scene, camera_from_above(4.0, 20.0), settings);
    EXPECT_NEAR(middle(points) / triangles, 1.0, 0.1);
}

TEST_F(WorldLight, AClosedRoomIsBlack) {
    // Walls without thickness, a corner in every direction. What leaks through is less than a thousandth of
    // the world.
    for (const double turn : {0.0, 33.0}) {
        scene::Scene scene = under_world(1.0F);
        add_walls(scene, 6, 1.0F);
        const glm::dmat4 turned = rotated(turn, glm::normalize(glm::dvec3(0.3, 0.5, 1.0)));
        for (scene::Node& node : scene.nodes) {
            node.matrix = turned * node.matrix.value();
        }
        CameraView camera = camera_inside();
        camera.world_from_camera = turned * camera.world_from_camera;
        const Rendered r = draw(scene, camera, lit_directly(256));
        EXPECT_LT(r.mean(), 1e-3) << turn;
        EXPECT_LT(*std::max_element(r.image.rgb.begin(), r.image.rgb.end()), 0.02F)
            << turn << ", the worst pixel";
    }
}

TEST_F(WorldLight, AnOpenRoomIsNotDarkenedByItsSeals) {
    // The floor of a room without a lid: form factor of two squares a side apart, middle to whole, is 0.2394
    // (Howell's catalogue, parallel squares: 4 / (2 pi) * 2 * (1 / sqrt(5)) * atan(1 / sqrt(5)) for a side of
    // 2 and a distance of 2). Texels are a twentieth of a side: 3 % of the light.
    scene::Scene scene = under_world(1.0F);
    add_walls(scene, 5, 0.0F);
    scene.materials.clear();
    add_diffuse(scene, glm::vec3(1.0F));
    CameraView camera = camera_from_above(0.2, 0.5);
    camera.camera.far_m = 10.0F;
    const double x = 0.5;
    const double expected =
        2.0 / pi * 2.0 * (x / std::sqrt(1.0 + x * x)) * std::atan(x / std::sqrt(1.0 + x * x));
    EXPECT_NEAR(middle(draw(scene, camera, lit_directly(1024))) / expected, 1.0, 0.05);
}

TEST_F(WorldLight, AWhiteCornerFillsUpToTheWorld) {
    // Whatever the shape, a white surface under a world of 1 shows 1 once all bounces are there. Two faces of
    // a corner see 0.29 of each other at most: after four bounces less than 0.3 % is missing. Bounding the
    // lights takes up to 2 %.
    scene::Scene scene = under_world(1.0F);
    const int square = add_square(scene, 2.0F, add_diffuse(scene));
    add_mesh_node(scene, square, moved({1.0, 0.0, 0.0}));
    add_mesh_node(scene, square, rotated(90.0, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}));
    CameraView camera = camera_from_above(1.0, 20.0);
    camera.world_from_camera = moved({0.7, 0.0, 0.0}) * camera.world_from_camera;
    Settings settings = lit_directly(256);
    const double direct = middle(draw(scene, camera, settings));
    // By the form factor of the wall, (atan(1 / x) - x / r atan(1 / r)) / pi at its middle with r^2 = x^2
    // + 4.
    EXPECT_NEAR(direct, 1.0 - 0.259, 0.02);
    settings.technique = Technique::ism;
    settings.bounces = 4;
    settings.bounce_vpls = 256;
    const double filled = middle(draw(scene, camera, settings));
    EXPECT_NEAR(filled, 1.0, 0.03);
}

TEST_F(WorldLight, ItsBouncesComeFromWhereTheyMatter) {
    // A white ground a hundred times as wide as the roof over it. At the middle of the roof's underside, h
    // above the ground, what arrives is the ground's light: that of the ground under the open sky, less the
    // roof's own shadow. Held against a ground so small that its points need no thinning.
    const auto under_roof = [](float ground) {
        scene::Scene scene = under_world(1.0F);
        add_mesh_node(scene, add_square(scene, ground, add_diffuse(scene, glm::vec3(0.8F))), glm::dmat4(1.0));
        add_mesh_node(scene, add_box(scene, glm::vec3(1.0F, 1.0F, 0.1F), add_diffuse(scene)),
                      moved({0.0, 0.0, 1.1}));
        CameraView camera = camera_from_above(1.0, 0.5);
        camera.camera.far_m = 5.0F;
        camera.world_from_camera = rotated(180.0, {1.0, 0.0, 0.0}, {0.0, 0.0, 0.5}) * moved({0.0, 0.0, 0.1});
        Settings settings = lit_directly(256);
        settings.technique = Technique::ism;
        settings.bounce_vpls = 256;
        return middle(draw(scene, camera, settings));
    };
    const double near = under_roof(20.0F);
    EXPECT_GT(near, 0.3);
    // 5 %: what 256 lights at other places differ by; the ground beyond adds 1 % itself.
    EXPECT_NEAR(under_roof(200.0F) / near, 1.0, 0.05);
}

TEST_F(WorldLight, WithoutItsLightsNothingHidesIt) {
    scene::Scene scene = under_world(1.0F);
    add_walls(scene, 6, 1.0F);
    const Rendered r = draw(scene, camera_inside(), lit_directly(0));
    EXPECT_THAT(r.report.executed, Not(Contains("ism disks")));
    EXPECT_NEAR(middle(r), 1.0, 1e-3);
}

TEST_F(WorldLight, ABlackOneCostsNothing) {
    scene::Scene scene = under_world(0.0F);
    add_walls(scene, 6, 1.0F);
    const Rendered r = draw(scene, camera_inside(), lit_directly(256));
    EXPECT_THAT(r.report.executed, Not(Contains("ism disks")));
    EXPECT_THAT(r.report.executed, Not(Contains("vpl gather")));
    EXPECT_EQ(r.report.points, 0U);
}

}  // namespace
}  // namespace bounce::test
