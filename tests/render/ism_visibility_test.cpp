// SPDX-License-Identifier: Apache-2.0
//
// What hides bounced light: one light on a wall against the closed form, a blocker, thin walls, a surface on
// its own.
#include "ism_fixture.h"
#include "scene/refine.h"

namespace bounce::test {
namespace {

constexpr int size = 40;

class IsmVisibility : public ::testing::Test {
  protected:
    void SetUp() override { require_context(); }

    // A pointer's light on the wall, a floor that it lights, and a ball between: by similar triangles its
    // shadow's middle is the floor's.
    static scene::Scene ball_scene(const glm::dvec3& at = {-1.0, 0.0, 0.75}) {
        scene::Scene scene = corner_scene();
        add_pointer(scene);
        add_mesh_node(scene, add_ball(scene, add_diffuse(scene), 0.25F), moved(at));
        return scene;
    }
    static double floor_at(const Rendered& r, double x, double y) {
        const glm::ivec2 p = pixel_of(x, y, size);
        return r.at(p.x, p.y).x;
    }
    static Settings with(Splat splat, int map_size) {
        Settings settings = bounced(size);
        settings.vpls = 16;
        settings.interleave = 1;
        settings.splat = splat;
        settings.ism_size = map_size;
        return settings;
    }
    static Settings without(Settings settings) {
        settings.visibility = Visibility::none;
        return settings;
    }
    static constexpr Splat splats[] = {Splat::disks, Splat::compute, Splat::points};
    static const char* name(Splat splat) {
        return splat == Splat::disks ? "disks" : splat == Splat::compute ? "compute" : "points";
    }
};

TEST_F(IsmVisibility, OneLightAboveAPlaneIsTheClosedForm) {
    scene::Scene scene = corner_scene();
    add_pointer(scene);
    for (const bool near_field : {false, true}) {
        for (const bool drop_hull : {false, true}) {
            Settings settings = with(Splat::disks, 64);
            settings.near_field = near_field;
            settings.drop_hull = drop_hull;
            const Rendered r = draw(scene, floor_camera(), settings);
            const double flux = 0.6 * 100.0 / (4.0 * pi) * 2.0 * pi * (1.0 - std::cos(0.01));
            for (int y = 0; y < size; ++y) {
                for (int x = 2; x < size; ++x) {
                    const glm::dvec3 at(4.0 * ((x + 0.5) / size - 0.5), 4.0 * (0.5 - (y + 0.5) / size), 0.0);
                    const glm::dvec3 d = at - glm::dvec3(-2.0, 0.0, 1.5);
                    const double d2 = glm::dot(d, d);
                    const double expected =
                        0.8 / pi * flux / pi * (d.x / std::sqrt(d2)) * (-d.z / std::sqrt(d2)) / d2;
                    // Halves between gather and picture: 11 bits; the spot's mean over its cone and its
                    // pixels: 1 %.
                    ASSERT_NEAR(r.at(x, y).x / expected, 1.0, 0.012) << x << ' ' << y;
                    ASSERT_NEAR(r.at(x, y).y / r.at(x, y).x, 0.2 / 0.6, 0.002);
                }
            }
        }
    }
}

// Pixels of the floor that the ball hides from (-2, 0, 1.5), by rays.
double hidden_pixels(const glm::dvec3& ball) {
    double count = 0.0;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const glm::dvec3 at(4.0 * ((x + 0.5) / size - 0.5), 4.0 * (0.5 - (y + 0.5) / size), 0.0);
            const glm::dvec3 light(-2.0, 0.0, 1.5);
            const glm::dvec3 ray = glm::normalize(at - light);
            const glm::dvec3 off = ball - light - ray * glm::dot(ball - light, ray);
            count += glm::length(off) < 0.25 ? 1.0 : 0.0;
        }
    }
    return count;
}

double dark_pixels(const Rendered& r, const Rendered& open) {
    double count = 0.0;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            count += r.at(x, y).x < 0.5 * open.at(x, y).x ? 1.0 : 0.0;
        }
    }
    return count;
}

TEST_F(IsmVisibility, ABlockerHidesWhatIsBehindItAndNothingElse) {
    const scene::Scene scene = ball_scene();
    const Rendered open = draw(scene, floor_camera(), without(with(Splat::disks, 64)));
    const double hidden = hidden_pixels({-1.0, 0.0, 0.75});
    ASSERT_GT(hidden, 100.0);
    for (const Splat splat : splats) {
        for (const int map_size : {32, 64, 128, 256}) {
            Settings settings = with(splat, map_size);
            settings.pull_push = PullPush::off;
            const Rendered r = draw(scene, floor_camera(), settings);
            // Two of the 16 maps may have a hole there.
            for (const double x : {-0.3, 0.0, 0.3}) {
                EXPECT_LE(floor_at(r, x, 0.0), 0.13 * floor_at(open, x, 0.0))
                    << name(splat) << ' ' << map_size;
            }
            for (const glm::dvec2& p : {glm::dvec2(0.0, 1.0), glm::dvec2(0.0, -1.0), glm::dvec2(-1.7, 0.0),
                                        glm::dvec2(-1.0, 1.5)}) {
                EXPECT_NEAR(floor_at(r, p.x, p.y) / floor_at(open, p.x, p.y), 1.0, 2e-3)
                    << name(splat) << ' ' << map_size;
            }
            // Disks keep the outline, squares of whole texels widen it.
            const double squares = map_size == 32    ? 2.5
                                   : map_size == 64  ? 1.5
                                   : map_size == 128 ? 1.28
                                                     : 1.13;
            const double most = splat == Splat::disks ? 1.06 : squares;
            EXPECT_LE(dark_pixels(r, open) / hidden, most) << name(splat) << ' ' << map_size;
            EXPECT_GE(dark_pixels(r, open) / hidden, 0.94) << name(splat) << ' ' << map_size;
        }
    }
}

TEST_F(IsmVisibility, SplatsAreAsLargeAsWhatTheyStandFor) {
    // 256 points on a ball, each four texels wide and more: nothing shows between them. Towards the outline,
    // where the ball turns away, they are as narrow as what they stand for, and grow it little.
    const scene::Scene scene = ball_scene();
    const Rendered open = draw(scene, floor_camera(), without(with(Splat::disks, 64)));
    for (const Splat splat : splats) {
        Settings settings = with(splat, 256);
        settings.pull_push = PullPush::off;
        settings.ism_points = 256;
        const double dark =
            dark_pixels(draw(scene, floor_camera(), settings), open) / hidden_pixels({-1.0, 0.0, 0.75});
        EXPECT_GE(dark, 0.97) << name(splat);
        EXPECT_LE(dark, splat == Splat::disks ? 1.04 : 1.08) << name(splat);
    }
}

TEST_F(IsmVisibility, BoxesDrawnWholeHideExactly) {
    // Twelve large triangles: no points at all. The top edge of the box casts the edge of its shadow.
    scene::Scene scene = corner_scene();
    add_pointer(scene);
    add_mesh_node(scene, add_box(scene, {0.05F, 0.6F, 0.375F}, 0), moved({-1.0, 0.0, 0.375}));
    for (const int map_size : {32, 64, 128, 256}) {
        const Settings settings = with(Splat::disks, map_size);
        const Rendered r = draw(scene, floor_camera(), settings);
        const Rendered open = draw(scene, floor_camera(), without(settings));
        // From (-2, 1.5) over (-0.95, 0.75): to x = 0.1. A texel of the smallest map is 0.1 m wide there and
        // more.
        const double reach = 4.0 / map_size;
        for (int x = 0; x < size; ++x) {
            const double at = 4.0 * ((x + 0.5) / size - 0.5);
            if (at > -0.9 && std::abs(at - 0.1) > 0.05 + 2.0 * reach) {
                EXPECT_NEAR(r.at(x, size / 2).x / open.at(x, size / 2).x, at < 0.1 ? 0.0 : 1.0, 0.01)
                    << map_size << ' ' << at;
            }
        }
    }
}

TEST_F(IsmVisibility, FillingHolesDoesNotSpreadABallOverTheRoom) {
    // Surfaces on the hull are kept where holes are filled: what lies behind the ball must not count as one.
    const scene::Scene scene = ball_scene();
    const Rendered open = draw(scene, floor_camera(), without(with(Splat::disks, 64)));
    for (const Splat splat : {Splat::compute, Splat::points}) {
        Settings settings = with(splat, 256);
        settings.pull_push = PullPush::fill;
        const Rendered r = draw(scene, floor_camera(), settings);
        EXPECT_LE(dark_pixels(r, open) / hidden_pixels({-1.0, 0.0, 0.75}), 1.5) << name(splat);
    }
}

TEST_F(IsmVisibility, ASurfaceDoesNotHideItself) {
    // A floor and a wall with all their own splats in the maps.
    scene::Scene scene = corner_scene();
    add_wall_spot(scene);
    Settings settings = with(Splat::disks, 64);
    settings.vpls = 64;
    settings.interleave = 2;
    settings.drop_hull = false;
    const Rendered open = draw(scene, floor_camera(), without(settings));
    for (const int map_size : {32, 64, 128, 256}) {
        for (const bool large : {false, true}) {
            settings.ism_size = map_size;
            settings.large_triangles = large;
            const Rendered r = draw(scene, floor_camera(), settings);
            double least = 1.0;
            for (int y = 0; y < size; ++y) {
                for (int x = 1; x < size; ++x) {
                    least = std::min(least, r.at(x, y).x / open.at(x, y).x);
                }
            }
            EXPECT_GE(r.mean() / open.mean(), map_size == 32 ? 0.995 : 0.9995) << map_size << ' ' << large;
            EXPECT_LE(r.mean() / open.mean(), 1.0005) << map_size << ' ' << large;
            EXPECT_GE(least, map_size == 32 ? 0.85 : 0.98) << map_size << ' ' << large;
        }
    }
    // One depth a splat: a bias by the slope, and a price.
    for (const Splat splat : {Splat::compute, Splat::points}) {
        settings.splat = splat;
        settings.ism_size = 256;
        EXPECT_GE(draw(scene, floor_camera(), settings).mean() / open.mean(), 0.85) << name(splat);
    }
}

TEST_F(IsmVisibility, AFinelyCutWallHidesAsOneOfTwoTriangles) {
    scene::Scene scene = corner_scene();
    add_wall_spot(scene);
    add_mesh_node(scene, add_box(scene, {0.1F, 0.8F, 0.6F}, add_diffuse(scene)), moved({-1.0, 0.1, 0.7}));
    const Settings settings = with(Splat::disks, 64);
    const Rendered coarse = draw(scene, floor_camera(), settings);
    scene::refine_scene(scene, scene::refinement_by(30.0));
    const Rendered fine = draw(scene, floor_camera(), settings);
    EXPECT_EQ(coarse.report.large_triangles, 12U);
    EXPECT_EQ(fine.report.large_triangles, 12U);
    EXPECT_NEAR(fine.mean() / coarse.mean(), 1.0, 1e-3);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            ASSERT_NEAR(fine.at(x, y).x, coarse.at(x, y).x, 0.02 * coarse.mean()) << x << ' ' << y;
        }
    }
}

TEST_F(IsmVisibility, AFinelyCutShellKeepsItsLight) {
    // A light inside a single layer of thousands of triangles, a room around it: no large triangle, nothing
    // on the hull. Points spread over a surface leave part of it bare however many there are.
    scene::Scene scene;
    scene.from_blender = true;
    const int material = add_diffuse(scene, glm::vec3(0.8F));
    add_mesh_node(scene, add_square(scene, 4.0F, material), glm::dmat4(1.0));
    add_mesh_node(scene, add_square(scene, 4.0F, material), rotated(90.0, {0.0, 1.0, 0.0}, {-2.0, 0.0, 2.0}));
    add_mesh_node(scene, add_ball(scene, material, 0.6F), moved({0.2, 0.0, 1.2}));
    add_light(scene, light_of(scene::LightType::point), moved({0.3, 0.1, 1.3}));
    CameraView camera = floor_camera();
    for (const int map_size : {32, 64, 128}) {
        Settings settings = with(Splat::disks, map_size);
        settings.near_field = false;
        const double open = draw(scene, camera, without(settings)).mean();
        EXPECT_LE(draw(scene, camera, settings).mean() / open, 0.09) << map_size;
        // Small maps see the shell bend from texel to texel by more than planes of one surface may differ.
        settings.ism_points = map_size * map_size;
        const double most = map_size == 32 ? 0.08 : map_size == 64 ? 0.03 : 0.025;
        EXPECT_LE(draw(scene, camera, settings).mean() / open, most) << map_size;
    }
}

TEST_F(IsmVisibility, AThinWallDoesNotLeak) {
    scene::Scene scene;
    scene.from_blender = true;
    const int material = add_diffuse(scene, glm::vec3(0.8F));
    const int wall = add_square(scene, 4.0F, material);
    // A closed room 4 by 4 by 4 around (0, 0, 2) without its ceiling's picture: the camera looks from inside.
    add_mesh_node(scene, wall, glm::dmat4(1.0));
    add_mesh_node(scene, wall, rotated(180.0, {1.0, 0.0, 0.0}, {0.0, 0.0, 4.0}));
    for (const double side : {-1.0, 1.0}) {
        add_mesh_node(scene, wall, rotated(-90.0 * side, {0.0, 1.0, 0.0}, {2.0 * side, 0.0, 2.0}));
        add_mesh_node(scene, wall, rotated(90.0 * side, {1.0, 0.0, 0.0}, {0.0, 2.0 * side, 2.0}));
    }
    // Cut in two by a wall 1 cm thick; the light is on the left, the picture on the right.
    add_mesh_node(scene, add_box(scene, {0.005F, 2.0F, 2.0F}, material), moved({0.0, 0.0, 2.0}));
    add_light(scene, light_of(scene::LightType::point), moved({-1.0, 0.3, 2.5}));
    CameraView camera = camera_from_above(2.0, 3.0);
    camera.world_from_camera = moved({1.0, 0.0, 3.0});
    camera.camera.ymag = 2.0F;
    // What is left is light along the wall's foot, where a texel's middle passes below the floor: half a
    // texel.
    for (const bool large : {false, true}) {
        double before = 0.1;
        for (const int map_size : {32, 64, 128}) {
            Settings settings = with(Splat::disks, map_size);
            settings.width = 20;
            settings.vpls = 256;
            settings.interleave = 4;
            settings.large_triangles = large;
            const Rendered r = draw(scene, camera, settings);
            const Rendered open = draw(scene, camera, without(settings));
            EXPECT_LE(r.mean() / open.mean(), large ? 3.6 / map_size : 8.0 / map_size)
                << map_size << ' ' << large;
            EXPECT_LE(r.mean() / open.mean(), before) << map_size << ": finer maps leak less";
            before = r.mean() / open.mean();
            double away = 0.0;
            double open_away = 0.0;
            for (int y = 0; y < size; ++y) {
                for (int x = 10; x < 20; ++x) {
                    away += r.at(x, y).x;
                    open_away += open.at(x, y).x;
                }
            }
            EXPECT_LE(away / open_away, large ? 1e-3 : 0.06) << map_size << ": away from the foot";
        }
    }
}

}  // namespace
}  // namespace bounce::test
