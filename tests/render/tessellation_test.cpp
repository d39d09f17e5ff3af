// SPDX-License-Identifier: Apache-2.0
//
// Splats of points that tessellation makes: as many, as large and where stored points are, without storing
// any.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "ism_fixture.h"
#include "scene/refine.h"

namespace bounce::test {
namespace {

using ::testing::Contains;
using ::testing::Not;

class Tessellation : public ::testing::Test {
  protected:
    void SetUp() override { require_context(); }

    static Settings settings(Splat splat, int size = 40) {
        Settings s = bounced(size);
        s.splat = splat;
        s.interleave = 2;
        s.vpls = 64;
        return s;
    }
    // Of every map's splats, 64 maps of 64 pixels each: the share of texels that are hit, and the mean depth
    // of these, render units. Without the rim, where rounding says which points of the light's own wall are
    // before it.
    struct Coverage {
        double share = 0.0;
        double depth = 0.0;
    };
    static Coverage coverage(const scene::Scene& scene, Settings s, double time_s = 0.0) {
        s.show = Show::ism_splats;
        const Rendered r = draw(scene, floor_camera(), s, time_s);
        double hit = 0.0;
        double empty = 0.0;
        double depth = 0.0;
        for (int y = 0; y < s.height; ++y) {
            for (int x = 0; x < s.width; ++x) {
                const glm::dvec2 st(x % 64 - 31.5, y % 64 - 31.5);
                if (glm::length(st) > 0.9 * 32.0) {
                    continue;
                }
                const glm::dvec3 color = r.at(x, y);
                const bool grey = color.r > 0.0 && color.r == color.b;
                hit += grey ? 1.0 : 0.0;
                empty += !grey && color.b > 0.0 ? 1.0 : 0.0;
                depth += grey ? std::sqrt(color.r) : 0.0;
            }
        }
        return {hit / (hit + empty), depth / std::max(hit, 1.0)};
    }
    // One texel a pixel of 64 maps of 64 x 64 texels; maps of a corner with all its surfaces.
    static Settings atlas(Splat splat, int points) {
        Settings s = settings(splat, 512);
        s.ism_points = points;
        s.drop_hull = false;
        return s;
    }
    static double error(const Rendered& a, const Rendered& b) {
        double sum = 0.0;
        double squares = 0.0;
        for (size_t i = 0; i < a.image.rgb.size(); ++i) {
            const double off = static_cast<double>(a.image.rgb[i] - b.image.rgb[i]);
            sum += off * off;
            squares += static_cast<double>(b.image.rgb[i] * b.image.rgb[i]);
        }
        return std::sqrt(sum / squares);
    }
    static scene::Scene ball_scene() {
        scene::Scene scene = corner_scene();
        add_wall_spot(scene);
        add_mesh_node(scene, add_ball(scene, add_diffuse(scene), 0.4F), moved({-0.8, 0.1, 0.7}));
        return scene;
    }
    // Against maps of triangles with the same lights: no worse than stored points.
    static void expect_as_good_as_points(const scene::Scene& scene, double time_s = 0.0) {
        Settings s = settings(Splat::compute);
        s.ism_points = 2048;
        s.ism_size = 128;
        const Rendered points = draw(scene, floor_camera(), s, time_s);
        s.splat = Splat::tessellation;
        const Rendered made = draw(scene, floor_camera(), s, time_s);
        s.visibility = Visibility::shadow_maps;
        s.ism_size = 256;
        const Rendered exact = draw(scene, floor_camera(), s, time_s);
        s.visibility = Visibility::none;
        const Rendered open = draw(scene, floor_camera(), s, time_s);
        EXPECT_THAT(made.report.executed, Contains("ism tessellation"));
        const double of_points = error(points, exact);
        EXPECT_LT(of_points, 0.5 * error(open, exact)) << "a case that tells";
        // Stored points are stratified over all surfaces, these over each triangle: of those that have less
        // than a point a map they are chance.
        EXPECT_LT(error(made, exact), 1.5 * of_points);
        EXPECT_NEAR(made.mean() / points.mean(), 1.0, 0.02);
    }
};

TEST_F(Tessellation, DepthOfAPlaneFromALightIsTheClosedForm) {
    // The pointer's light at (-2, 0, 1.5) looks along +X; its map's axes are -Z and +Y (lib/math.glsl:
    // orthonormal_basis()). The floor is all that it can see.
    scene::Scene scene = corner_scene();
    add_pointer(scene);
    Settings s = settings(Splat::tessellation, 64);
    s.vpls = s.interleave = 1;
    s.ism_points = 16384;
    s.drop_hull = false;
    s.show = Show::ism;
    s.shown_vpl = 0;
    const Rendered r = draw(scene, floor_camera(), s);
    const double scale = 1.0 / std::sqrt(4.0 * 4.0 * 3.0);  // the scene's diagonal is 1
    int floor = 0;
    int holes = 0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const glm::dvec2 st((x + 0.5) / 32.0 - 1.0, 1.0 - (y + 0.5) / 32.0);
            const double r2 = glm::dot(st, st);
            const glm::dvec3 local = glm::dvec3(2.0 * st.x, 2.0 * st.y, 1.0 - r2) / (1.0 + r2);
            const glm::dvec3 way(local.z, local.y, -local.x);
            const double distance = way.z < 0.0 ? 1.5 / -way.z : 1e9;
            const glm::dvec3 hit = glm::dvec3(-2.0, 0.0, 1.5) + way * distance;
            const glm::dvec3 color = r.at(x, y);
            const bool grey = color.r > 0.0 && color.r == color.b;
            // Away from its ends, where a splat reaches over.
            if (r2 < 0.95 && std::abs(hit.y) < 1.8 && hit.x > -1.9 && hit.x < 1.7) {
                ++floor;
                if (!grey) {
                    ++holes;
                    continue;
                }
                // A texel's nearest splat's one depth: half the texel's slope and half a splat's.
                const double texel = 2.0 / 32.0 / (1.0 + r2);
                const double slope = distance * texel * std::sqrt(1.0 / (way.z * way.z) - 1.0);
                EXPECT_NEAR(std::sqrt(color.r), distance * scale, (1.1 * slope + 0.03 * distance) * scale)
                    << x << ' ' << y;
            } else if (r2 < 0.9 && way.z > 0.1) {
                EXPECT_FALSE(grey) << x << ' ' << y << ": nothing is above the light";
            }
        }
    }
    EXPECT_GT(floor, 500);
    EXPECT_LT(holes, 0.03 * floor) << "eight points a texel at the middle, fewer towards the foot";
}

TEST_F(Tessellation, HasTheCoverageOfStoredPoints) {
    // Numbers and sizes alike: what is hit is about the same share. Each map's points have about the area of
    // all that is to be hit, so that the share falls as they clump: 63 % were they chance, more the more
    // evenly they lie, as stored ones do over all surfaces and made ones over each of these four triangles.
    // One patch gives 4,160 points; without the others there would be half as much at the last number.
    scene::Scene scene = corner_scene();
    add_wall_spot(scene);
    for (const int points : {32, 1024, 8192}) {
        const Coverage stored = coverage(scene, atlas(Splat::points, points));
        const Coverage made = coverage(scene, atlas(Splat::tessellation, points));
        EXPECT_GT(stored.share, 0.005);
        EXPECT_NEAR(made.share / stored.share, 1.0, 0.1) << points;
        EXPECT_NEAR(made.depth / stored.depth, 1.0, 0.04) << points;
    }
}

TEST_F(Tessellation, FurtherPiecesOfLargeTrianglesAreDrawn) {
    scene::Scene scene = corner_scene();
    add_wall_spot(scene);
    const Settings few = atlas(Splat::tessellation, 32);  // 64 maps, four triangles: 512 points each
    const Settings many = atlas(Splat::tessellation, 1024);
    EXPECT_THAT(draw(scene, floor_camera(), few).report.executed, Not(Contains("ism pieces")));
    EXPECT_THAT(draw(scene, floor_camera(), many).report.executed, Contains("ism pieces"));
}

TEST_F(Tessellation, HasTheCoverageOfStoredPointsOnFineMeshesToo) {
    // Far more triangles than points: few have one, and these are chance.
    scene::Scene scene = corner_scene();
    add_wall_spot(scene);
    scene::refine_scene(scene, scene::refinement_by(20000.0));
    for (const int points : {64, 512}) {
        const Coverage stored = coverage(scene, atlas(Splat::points, points));
        const Coverage made = coverage(scene, atlas(Splat::tessellation, points));
        EXPECT_NEAR(made.share / stored.share, 1.0, 0.15) << points;
        EXPECT_NEAR(made.depth / stored.depth, 1.0, 0.04) << points;
    }
}

TEST_F(Tessellation, HidesAsWellAsStoredPoints) {
    expect_as_good_as_points(ball_scene());
}

TEST_F(Tessellation, HidesBesideHugeTrianglesAsWell) {
    // A ball of many small triangles and walls of two, in one mesh.
    scene::Scene scene = ball_scene();
    scene::Primitive& ball = scene.meshes.back().primitives[0];
    const auto first = static_cast<uint32_t>(ball.positions.size());
    for (const glm::vec3& corner : {glm::vec3(-0.9F, -1.9F, -0.6F), glm::vec3(2.5F, -1.9F, -0.6F),
                                    glm::vec3(2.5F, -1.9F, 2.0F), glm::vec3(-0.9F, -1.9F, 2.0F)}) {
        ball.positions.push_back(corner);
        ball.normals.emplace_back(0.0F, 1.0F, 0.0F);
    }
    for (const uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) {
        ball.indices.push_back(first + i);
    }
    expect_as_good_as_points(scene);
}

TEST_F(Tessellation, HidesFarFinerMeshesAsWell) {
    scene::Scene scene = ball_scene();
    scene::refine_scene(scene, scene::refinement_by(100.0));
    expect_as_good_as_points(scene);
}

TEST_F(Tessellation, FollowsAMorphingMeshThatGrows) {
    // Three times as large at its end: nine times the area, as many more points.
    scene::Scene scene = corner_scene();
    add_wall_spot(scene);
    const int mesh = add_ball(scene, add_diffuse(scene), 0.15F);
    scene::Primitive& primitive = scene.meshes[static_cast<size_t>(mesh)].primitives[0];
    scene::MorphTarget grown;
    for (const glm::vec3& p : primitive.positions) {
        grown.positions.push_back(2.0F * p);
    }
    primitive.targets = {grown};
    const int node = add_mesh_node(scene, mesh, moved({-0.8, 0.1, 0.7}));
    scene.nodes[static_cast<size_t>(node)].weights = {0.0F};
    scene.frames = {1, 2, 1.0};
    scene::Animation animation;
    animation.samplers.push_back({scene::Interpolation::linear, 1, {0.0F, 1.0F}, {0.0F, 1.0F}});
    animation.channels.push_back({scene::Property::node_weights, node, 0});
    animation.duration_s = 1.0F;
    scene.animations.push_back(animation);
    expect_as_good_as_points(scene, 1.0);
    Settings s = atlas(Splat::tessellation, 512);
    s.drop_hull = true;
    EXPECT_GT(coverage(scene, s, 1.0).share, 3.0 * coverage(scene, s, 0.0).share);
}

TEST_F(Tessellation, DrawsEveryInstance) {
    scene::Scene scene = corner_scene();
    add_wall_spot(scene);
    scene::Node balls;
    balls.mesh = add_ball(scene, add_diffuse(scene), 0.25F);
    for (const double y : {-1.0, -0.3, 0.4, 1.1}) {
        balls.instances.push_back(moved({-0.8, y, 0.6}) *
                                  glm::scale(glm::dmat4(1.0), glm::dvec3(1.0 + 0.3 * y)));
    }
    add_node(scene, balls);
    expect_as_good_as_points(scene);
}

TEST_F(Tessellation, CutOutsAreLeftOut) {
    scene::Scene scene = corner_scene();
    add_wall_spot(scene);
    const int cut = add_diffuse(scene);
    add_mesh_node(scene, add_ball(scene, cut, 0.4F), moved({-0.8, 0.1, 0.7}));
    scene::Material& material = scene.materials[static_cast<size_t>(cut)];
    const auto with = [&](Visibility visibility) {
        Settings s = settings(Splat::tessellation);
        s.visibility = visibility;
        return draw(scene, floor_camera(), s).mean();
    };
    const double open = with(Visibility::none);
    const double solid = with(Visibility::ism);
    ASSERT_LT(solid, 0.96 * open);
    // The ball itself is a hole: no draw of it is made, and what the vertices say hides nothing either.
    material.alpha_mode = scene::AlphaMode::mask;
    scene::Primitive& ball = scene.meshes.back().primitives[0];
    ball.colors.assign(ball.positions.size(), glm::vec4(1.0F, 1.0F, 1.0F, 0.4F));
    EXPECT_NEAR(with(Visibility::ism) / with(Visibility::none), 1.0, 1e-3);
    // Half of it is there: its lower half.
    for (size_t v = 0; v < ball.positions.size(); ++v) {
        ball.colors[v].a = ball.positions[v].z > 0.0F ? 0.0F : 1.0F;
    }
    const double half = with(Visibility::ism) / with(Visibility::none);
    EXPECT_LT(half, 0.98);
    Settings stored = settings(Splat::compute);
    EXPECT_NEAR(with(Visibility::ism) / draw(scene, floor_camera(), stored).mean(), 1.0, 0.03);
    // Of a blended one a part of the points is.
    material.alpha_mode = scene::AlphaMode::blend;
    for (glm::vec4& color : ball.colors) {
        color.a = 0.5F;
    }
    EXPECT_NEAR(with(Visibility::ism) / draw(scene, floor_camera(), stored).mean(), 1.0, 0.03);
}

TEST_F(Tessellation, SurfacesOnTheHullAreDropped) {
    scene::Scene scene = ball_scene();
    Settings s = atlas(Splat::tessellation, 1024);
    const double all = coverage(scene, s).share;
    s.drop_hull = true;
    const double inside = coverage(scene, s).share;
    Settings stored = atlas(Splat::points, 1024);
    stored.drop_hull = true;
    EXPECT_LT(inside, 0.5 * all);
    EXPECT_NEAR(inside / coverage(scene, stored).share, 1.0, 0.03);
    // A box whose floor alone is on the hull: bits of its triangles.
    scene::Scene boxes = corner_scene();
    add_wall_spot(boxes);
    add_mesh_node(boxes, add_box(boxes, {0.3F, 0.3F, 0.3F}, add_diffuse(boxes)), moved({-0.8, 0.1, 0.3}));
    EXPECT_NEAR(coverage(boxes, s).share / coverage(boxes, stored).share, 1.0, 0.03);
}

TEST_F(Tessellation, NoPointIsStoredOrMoved) {
    const Rendered r = draw(ball_scene(), floor_camera(), settings(Splat::tessellation));
    EXPECT_EQ(r.report.points, 0U);
    EXPECT_GT(r.report.points_a_map, 0);
    EXPECT_THAT(r.report.executed, Not(Contains("points")));
    const auto left_out = std::find_if(r.report.left_out.begin(), r.report.left_out.end(),
                                       [](const LeftOut& l) { return l.pass == "points"; });
    ASSERT_NE(left_out, r.report.left_out.end());
    EXPECT_EQ(left_out->reason, "tessellation makes them as they are drawn, and nothing else needs any");
    EXPECT_THAT(draw(ball_scene(), floor_camera(), settings(Splat::points)).report.executed,
                Contains("points"));
}

TEST_F(Tessellation, FurtherBouncesHaveTheirPointsBesideIt) {
    Settings s = settings(Splat::tessellation);
    s.bounces = 2;
    s.bounce_vpls = 64;
    for (const bool irsm : {false, true}) {
        s.bounce_source = irsm ? BounceSource::irsm : BounceSource::points;
        const Rendered made = draw(ball_scene(), floor_camera(), s);
        EXPECT_EQ(std::count(made.report.executed.begin(), made.report.executed.end(), "ism tessellation"),
                  2);
        EXPECT_THAT(made.report.executed, Contains("points")) << "that further bounces are drawn from";
        EXPECT_EQ(made.report.points, 0U) << "none that hides";
        Settings stored = s;
        stored.splat = Splat::compute;
        EXPECT_NEAR(made.mean() / draw(ball_scene(), floor_camera(), stored).mean(), 1.0, 0.02) << irsm;
    }
}

TEST_F(Tessellation, NothingThatHidesIsNoError) {
    scene::Scene scene = corner_scene();  // all on the hull
    add_wall_spot(scene);
    const Rendered r = draw(scene, floor_camera(), settings(Splat::tessellation));
    EXPECT_THAT(r.report.executed, Not(Contains("ism tessellation")));
    EXPECT_GT(r.mean(), 0.0);
}

TEST_F(Tessellation, AutoSaysWhatItChoseAndDrawsThat) {
    Settings s = settings(Splat::automatic);
    const Rendered chosen = draw(ball_scene(), floor_camera(), s);
    ASSERT_TRUE(chosen.report.splat.has_value());
    EXPECT_FALSE(chosen.report.splat->reason.empty());
    s.splat = chosen.report.splat->splat;
    const Rendered same = draw(ball_scene(), floor_camera(), s);
    EXPECT_EQ(chosen.image.rgb, same.image.rgb);
    EXPECT_FALSE(same.report.splat.has_value());
}

}  // namespace
}  // namespace bounce::test
