// SPDX-License-Identifier: Apache-2.0
//
// Bounced light of the frames before: where it holds it takes the chance out of the choice of lights; where
// it does not there is nothing of it.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "ism_fixture.h"

namespace bounce::test {
namespace {

using ::testing::Contains;
using ::testing::Not;

class TemporalReuse : public ::testing::Test {
  protected:
    static constexpr int size = 48;
    void SetUp() override { require_context(); }

    static Settings settings(bool reuse) {
        Settings s = bounced(size);
        s.vpls = 64;
        s.temporal_reuse = reuse;
        s.count_gathered_pixels = true;
        return s;
    }
    // Frames of one renderer, each drawn and kept.
    class Film {
      public:
        explicit Film(const scene::Scene& scene) : renderer_(scene) {}
        Rendered next(const scene::Pose& pose, const Settings& s, const CameraView& camera = floor_camera()) {
            Rendered out;
            out.report = renderer_.render(pose, camera, s);
            out.image = renderer_.read_color();
            renderer_.keep_frame();
            return out;
        }
        Renderer& renderer() { return renderer_; }

      private:
        Renderer renderer_;
    };
    static double rms(const Image& a, const Image& b) {
        double sum = 0.0;
        for (size_t i = 0; i < a.rgb.size(); ++i) {
            const double off = static_cast<double>(a.rgb[i] - b.rgb[i]);
            sum += off * off;
        }
        return std::sqrt(sum / static_cast<double>(a.rgb.size()));
    }
    static double worst(const Image& a, const Image& b) {
        double most = 0.0;
        for (size_t i = 0; i < a.rgb.size(); ++i) {
            most = std::max(most, static_cast<double>(std::abs(a.rgb[i] - b.rgb[i])));
        }
        return most;
    }
    // A floor, a wall that a spot shines on, and a ball before it.
    struct Stage {
        scene::Scene scene = corner_scene();
        int ball = 0;
        Stage() {
            add_wall_spot(scene);
            ball = add_mesh_node(scene, add_ball(scene, add_diffuse(scene), 0.35F), moved({-0.6, 0.0, 0.6}));
        }
        [[nodiscard]] scene::Pose pose(const glm::dvec3& at = {-0.6, 0.0, 0.6}) const {
            scene::Pose out = scene::evaluate_pose(scene, 0.0);
            out.world_from_node[static_cast<size_t>(ball)] = moved(at);
            for (scene::DrawInstance& draw : out.draws) {
                if (draw.node == ball) {
                    draw.world_from_model = moved(at);
                }
            }
            return out;
        }
    };
    // Other lights in every frame, as a sequence begun elsewhere would give them.
    static Settings other_lights(Settings s, int frame) {
        s.vpls = 64 + 16 * (frame % 16);
        return s;
    }
};

TEST_F(TemporalReuse, AStandingPictureConvergesAndComesToRest) {
    const Stage stage;
    Settings exact = settings(false);
    exact.vpls = 4096;
    const Image truth = draw(stage.scene, floor_camera(), exact).image;
    const Image alone = draw(stage.scene, floor_camera(), settings(false)).image;
    Film film(stage.scene);
    std::vector<Image> with;
    constexpr int frames = 24;
    for (int frame = 0; frame < frames; ++frame) {
        const Rendered r = film.next(stage.pose(), settings(true));
        with.push_back(r.image);
        ASSERT_TRUE(r.report.reuse.has_value());
        EXPECT_EQ(r.report.reuse->share, frame == 0 ? 0.0 : 1.0);
        EXPECT_EQ(r.report.reuse->reason, frame == 0 ? "there is no frame before it" : "");
    }
    EXPECT_EQ(with[0].rgb, alone.rgb) << "the first has the lights of a frame alone";
    EXPECT_NE(with[1].rgb, alone.rgb) << "the others have others";
    // Of n frames the n-th moves the mean by about an n-th: by a tenth of what the second does. Four times
    // that is a mean that forgets early, of 6 frames.
    EXPECT_LT(rms(with[frames - 1], with[frames - 2]), 0.4 * rms(with[1], with[0]));
    EXPECT_LT(rms(with[frames - 1], truth), 0.8 * rms(alone, truth));
}

TEST_F(TemporalReuse, NothingIsLeftOfALightThatWentOutOrMoved) {
    const Stage stage;
    const scene::Pose before = stage.pose();
    scene::Pose dark = before;
    dark.lights[0].power_w = 0.01F;
    scene::Pose away = before;
    away.light_instances[0].world_from_light = rotated(40.0, {0.0, 1.0, 0.0}, {0.5, -0.8, 2.0});
    scene::Pose blue = before;
    blue.lights[0].color = glm::vec3(0.1F, 0.2F, 1.0F);
    for (const scene::Pose& after : {dark, away, blue}) {
        Film film(stage.scene);
        for (int frame = 0; frame < 4; ++frame) {
            film.next(before, other_lights(settings(true), frame));
        }
        const Rendered with = film.next(after, settings(true));
        EXPECT_EQ(with.report.reuse->reason, "a light moved or changed");
        Film fresh(stage.scene);
        const Rendered alone = fresh.next(after, settings(false));
        EXPECT_EQ(with.image.rgb, alone.image.rgb) << "bit for bit";
    }
}

TEST_F(TemporalReuse, AMovingShadowLeavesNoTrail) {
    // A ball between the floor and the one place on the wall that is lit: all lights stand there, so that a
    // frame alone is what there is to be. Its shadow goes over the floor by a quarter of its width a frame,
    // and where it was there must be nothing of its dark.
    scene::Scene scene = corner_scene();
    add_pointer(scene);
    const int ball =
        add_mesh_node(scene, add_ball(scene, add_diffuse(scene), 0.25F), moved({-1.0, 0.0, 0.75}));
    const auto pose_at = [&](double y) {
        scene::Pose pose = scene::evaluate_pose(scene, 0.0);
        pose.world_from_node[static_cast<size_t>(ball)] = moved({-1.0, y, 0.75});
        for (scene::DrawInstance& draw : pose.draws) {
            draw.world_from_model = draw.node == ball ? moved({-1.0, y, 0.75}) : draw.world_from_model;
        }
        return pose;
    };
    Film film(scene);
    Film alone(scene);
    double reused = 0.0;
    constexpr int frames = 8;
    for (int frame = 0; frame < frames; ++frame) {
        const scene::Pose pose = pose_at(-0.5 + 0.12 * frame);
        const Rendered with = film.next(pose, settings(true));
        const Rendered own = alone.next(pose, settings(false));
        // On the floor beside the ball, which has its own light as it moves.
        const glm::ivec2 middle = pixel_of(-1.0, -0.5 + 0.12 * frame, size);
        double squares = 0.0;
        double most = 0.0;
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                if (std::hypot(x - middle.x, y - middle.y) > 0.25 / 4.0 * size + 2.0) {
                    const double off = std::abs(with.at(x, y).x - own.at(x, y).x);
                    squares += off * off / (size * size);
                    most = std::max(most, off);
                }
            }
        }
        // At the shadow's edge maps differ by a texel from light to light, and there a part of a pixel may
        // stay.
        EXPECT_LT(std::sqrt(squares), 0.02 * own.mean()) << frame;
        EXPECT_LT(most, 0.6 * own.mean()) << frame;
        reused += with.report.reuse->share / (frames - 1);
        if (frame > 0) {
            EXPECT_THAT(with.report.executed, Contains("motion"));
            // Where the shadow's middle was the frame before last it is as bright as alone.
            const double behind = 2.0 * (-0.5 + 0.12 * (frame - 3));
            const glm::ivec2 p = pixel_of(0.0, behind, size);
            if (frame >= 3) {
                EXPECT_NEAR(with.at(p.x, p.y).x / own.at(p.x, p.y).x, 1.0, 0.05) << frame;
            }
        }
    }
    EXPECT_GT(reused, 0.85) << "a case that tells: most of the picture is reused";
}

// A film of a moving thing against exact pictures: no worse than each frame alone.
void expect_no_worse(const std::vector<double>& with, const std::vector<double>& own) {
    double sum_with = 0.0;
    double sum_own = 0.0;
    for (size_t i = 1; i < with.size(); ++i) {
        EXPECT_LT(with[i], 1.25 * own[i]) << i;
        sum_with += with[i];
        sum_own += own[i];
    }
    EXPECT_LT(sum_with, sum_own);
}

TEST_F(TemporalReuse, AMovingBallIsNoWorseThanEachFrameAlone) {
    // In and out of the light, so that the lights are chosen anew in each frame.
    const Stage stage;
    Settings exact = settings(false);
    exact.vpls = 4096;
    Film film(stage.scene);
    Film alone(stage.scene);
    Film reference(stage.scene);
    std::vector<double> with_errors;
    std::vector<double> own_errors;
    for (int frame = 0; frame < 10; ++frame) {
        const scene::Pose pose = stage.pose({-0.6 + 0.12 * frame, -0.9 + 0.12 * frame, 0.6});
        const Image truth = reference.next(pose, exact).image;
        with_errors.push_back(rms(film.next(pose, settings(true)).image, truth));
        own_errors.push_back(rms(alone.next(pose, settings(false)).image, truth));
    }
    expect_no_worse(with_errors, own_errors);
}

TEST_F(TemporalReuse, WhatComesIntoSightHasNoLightBefore) {
    // The ball is gone at once: what it hid of the floor was never seen.
    const Stage stage;
    Film film(stage.scene);
    film.next(stage.pose({0.9, 0.9, 0.6}), settings(true));
    const scene::Pose pose = stage.pose({0.9, 0.9, -5.0});
    const Rendered with = film.next(pose, settings(true));
    Film fresh(stage.scene);
    const Rendered own = fresh.next(pose, settings(false));
    const glm::ivec2 p = pixel_of(0.9, 0.9, size);
    for (int y = p.y - 2; y <= p.y + 2; ++y) {
        for (int x = p.x - 2; x <= p.x + 2; ++x) {
            EXPECT_EQ(with.at(x, y), own.at(x, y)) << x << ' ' << y;
        }
    }
    EXPECT_LT(with.report.reuse->share, 0.99);
    EXPECT_GT(with.report.reuse->share, 0.8);
}

TEST_F(TemporalReuse, FollowsTheCamera) {
    const Stage stage;
    Settings exact = settings(false);
    exact.vpls = 4096;
    Film film(stage.scene);
    Film fresh(stage.scene);
    Film reference(stage.scene);
    double with_error = 0.0;
    double own_error = 0.0;
    for (int frame = 0; frame < 16; ++frame) {
        CameraView camera = camera_from_above(1.5, 50.0);
        camera.camera.far_m = 100.0F;
        // Pixels and a part aside, a part of one down a frame.
        camera.world_from_camera =
            moved({1.35 * 1.5 / size * frame, -0.3 * 1.5 / size * frame, 0.0}) * camera.world_from_camera;
        const Rendered with = film.next(stage.pose(), other_lights(settings(true), frame), camera);
        const Rendered own = fresh.next(stage.pose(), other_lights(settings(false), frame), camera);
        if (frame >= 8) {
            const Rendered exactly = reference.next(stage.pose(), exact, camera);
            with_error += rms(with.image, exactly.image);
            own_error += rms(own.image, exactly.image);
            EXPECT_GT(with.report.reuse->share, 0.9) << frame;
            EXPECT_LT(with.report.reuse->share, 1.0) << frame << ": what comes in from the side is new";
            EXPECT_THAT(with.report.executed, Not(Contains("motion"))) << "nothing but the camera moved";
        }
    }
    EXPECT_LT(with_error, 0.85 * own_error);
}

TEST_F(TemporalReuse, AFrameDrawnTwiceIsTheSame) {
    const Stage stage;
    Film film(stage.scene);
    film.next(stage.pose(), other_lights(settings(true), 0));
    film.next(stage.pose(), other_lights(settings(true), 1));
    const scene::Pose pose = stage.pose({-0.5, 0.1, 0.6});
    const Settings s = other_lights(settings(true), 2);
    Renderer& renderer = film.renderer();
    (void)renderer.render(pose, floor_camera(), s);
    const Image once = renderer.read_color();
    (void)renderer.render(pose, floor_camera(), s);
    EXPECT_EQ(renderer.read_color().rgb, once.rgb);
    // Forgotten, it is the frame alone.
    renderer.forget_history();
    (void)renderer.render(pose, floor_camera(), s);
    const Image forgotten = renderer.read_color();
    EXPECT_NE(forgotten.rgb, once.rgb);
    Settings off = s;
    off.temporal_reuse = false;
    Film fresh(stage.scene);
    EXPECT_EQ(forgotten.rgb, fresh.next(pose, off).image.rgb);
}

TEST_F(TemporalReuse, AMorphingMeshIsFollowed) {
    Stage stage;
    scene::Primitive& primitive = stage.scene.meshes.back().primitives[0];
    scene::MorphTarget aside;
    aside.positions.assign(primitive.positions.size(), glm::vec3(0.5F, 0.5F, 0.0F));
    primitive.targets = {aside};
    stage.scene.nodes[static_cast<size_t>(stage.ball)].weights = {0.0F};
    Settings exact = settings(false);
    exact.vpls = 4096;
    Film film(stage.scene);
    Film alone(stage.scene);
    Film reference(stage.scene);
    std::vector<double> with_errors;
    std::vector<double> own_errors;
    for (int frame = 0; frame < 8; ++frame) {
        scene::Pose pose = stage.pose();
        pose.weights[static_cast<size_t>(stage.ball)] = {0.12F * static_cast<float>(frame)};
        const Image truth = reference.next(pose, exact).image;
        const Rendered with = film.next(pose, settings(true));
        with_errors.push_back(rms(with.image, truth));
        own_errors.push_back(rms(alone.next(pose, settings(false)).image, truth));
        if (frame > 0) {
            EXPECT_GT(with.report.reuse->share, 0.8) << frame;
            EXPECT_THAT(with.report.executed, Contains("motion"));
        }
    }
    expect_no_worse(with_errors, own_errors);
}

TEST_F(TemporalReuse, OtherSettingsBeginAnew) {
    const Stage stage;
    Film film(stage.scene);
    film.next(stage.pose(), settings(true));
    Settings two = settings(true);
    two.bounces = 2;
    two.bounce_vpls = 64;
    EXPECT_EQ(film.next(stage.pose(), two).report.reuse->reason, "the settings changed");
    EXPECT_EQ(film.next(stage.pose(), two).report.reuse->reason, "");
    Settings smaller = two;
    smaller.width = 32;
    EXPECT_EQ(film.next(stage.pose(), smaller).report.reuse->reason, "the picture's size changed");
    // A frame without it ends it.
    film.next(stage.pose(), settings(false));
    EXPECT_EQ(film.next(stage.pose(), settings(true)).report.reuse->reason, "there is no frame before it");
}

TEST_F(TemporalReuse, CostsNothingWhereItIsOff) {
    const Stage stage;
    const Rendered off = draw(stage.scene, floor_camera(), settings(false));
    for (const char* pass : {"temporal reuse", "light spread", "motion"}) {
        EXPECT_THAT(off.report.executed, Not(Contains(pass)));
    }
    EXPECT_FALSE(off.report.reuse.has_value());
    const auto reason = [&](Settings s) {
        const FrameReport report = draw(stage.scene, floor_camera(), s).report;
        const auto found = std::find_if(report.left_out.begin(), report.left_out.end(),
                                        [](const LeftOut& l) { return l.pass == "temporal reuse"; });
        return found == report.left_out.end() ? std::string() : found->reason;
    };
    EXPECT_EQ(reason(settings(false)), "it was not asked for");
    EXPECT_EQ(reason(settings(true)), "");
    Settings s = settings(true);
    s.interleave = 1;
    EXPECT_EQ(reason(s), "without interleaved pixels nothing says how far lights may differ");
    s = settings(true);
    s.shading = Shading::hybrid;
    EXPECT_EQ(reason(s), "light is gathered on simplified meshes");
    s = settings(true);
    s.show = Show::unblurred;
    EXPECT_EQ(reason(s), "the layer shows one frame's own data");
    s = settings(true);
    s.technique = Technique::direct;
    s.show = Show::shaded;
    EXPECT_EQ(reason(s), "technique ism alone keeps light");
}

}  // namespace
}  // namespace bounce::test
