// SPDX-License-Identifier: Apache-2.0
//
// What did not change since the frame before is not made again, and nobody sees it; what the scene does not
// need changes nothing when it is done all the same; memory is what was forecast.
#include <algorithm>
#include <deque>
#include <functional>

#include <gmock/gmock.h>

#include "core/error.h"
#include "gl/memory.h"
#include "image/metrics.h"
#include "ism_fixture.h"
#include "renderer/memory_fit.h"
#include "scene/primitive_bounds.h"

namespace bounce::test {
namespace {

using testing::AnyOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;
using Names = std::vector<std::string>;

// A corner with a ball, a spot on a wall and a point light with a size.
scene::Scene set_scene() {
    scene::Scene scene = corner_scene();
    add_wall_spot(scene);
    scene.lights[0].name = "Spot";
    add_mesh_node(scene, add_ball(scene, add_diffuse(scene, {0.7F, 0.5F, 0.4F}), 0.25F),
                  moved({-1.0, 0.0, 0.75}));
    scene::Light lamp;
    lamp.name = "Lamp";
    lamp.type = scene::LightType::point;
    lamp.power_w = 20.0F;
    lamp.radius_m = 0.2F;
    add_light(scene, lamp, moved({-0.5, -1.0, 1.5}));
    scene.world.color = glm::vec3(0.2F, 0.3F, 0.4F);
    for (scene::Mesh& mesh : scene.meshes) {  // as the loader does: what is not seen is told by them
        for (scene::Primitive& primitive : mesh.primitives)
            primitive.bounds = scene::primitive_bounds(primitive);
    }
    return scene;
}

Settings small(Technique technique = Technique::ism) {
    Settings settings;
    settings.technique = technique;
    settings.width = 48;
    settings.height = 32;
    settings.vpls = 64;
    settings.world_vpls = 64;
    settings.bounce_vpls = 32;
    settings.ism_size = 32;
    settings.interleave = 2;
    settings.shadow_size = 256;
    settings.soft_shadow_size = 64;
    settings.shadow_samples = 16;
    return settings;
}

void move_ball(scene::Pose& pose, double by) {
    const auto ball = std::find_if(pose.draws.rbegin(), pose.draws.rend(), [](const auto&) { return true; });
    pose.world_from_node[static_cast<size_t>(ball->node)][3].x += by;
    ball->world_from_model[3].x += by;
}

struct Changed {
    scene::Pose pose;
    CameraView camera;
};
using Change = std::function<void(Changed&, int)>;

class Unchanged : public testing::Test {
  protected:
    void SetUp() override { require_context(); }

    // Three frames with a change in each, and the first one's once more: by one renderer that keeps what did
    // not change, each beside a renderer of its own; or where it is to be quick the third alone. Returns what
    // the third frame ran.
    static Names run(const scene::Scene& scene, const Settings& settings, const Change& change,
                     bool quick = false) {
        Renderer keeping(scene);
        keeping.expect_frames(true);
        Names third;
        for (const int frame : quick ? std::vector{0, 1, 2} : std::vector{0, 1, 2, 0}) {
            Changed now{scene::evaluate_pose(scene, 0.0), camera_from_above(4.0, 10.0)};
            change(now, frame);
            const FrameReport report = keeping.render(now.pose, now.camera, settings);
            keeping.keep_frame();
            third = frame == 2 ? report.executed : third;
            if (quick && frame != 2) {
                continue;
            }
            const Image kept = keeping.read_color();
            Renderer fresh(scene);
            (void)fresh.render(now.pose, now.camera, settings);
            EXPECT_EQ(kept.rgb, fresh.read_color().rgb) << "frame " << frame;
        }
        return third;
    }
};

const Change k_camera = [](Changed& now, int frame) { now.camera.world_from_camera[3].x += 0.05 * frame; };

TEST_F(Unchanged, AMovingCameraPaysForTheViewAlone) {
    const Names passes = run(set_scene(), small(), k_camera);
    EXPECT_THAT(passes, Contains("gbuffer"));
    EXPECT_THAT(passes, Contains("vpl gather"));
    for (const char* name :
         {"shadow map: Spot", "rsm: Spot", "rsm: Lamp", "points", "vpl importance", "vpls", "ism disks",
          "ism triangles", "vpls, next bounce", "vpl importance, next bounce"}) {
        EXPECT_THAT(passes, Not(Contains(name)));
    }
}

TEST_F(Unchanged, ALightThatMovesLeavesTheOthersMapsAndTheCamerasSurfaces) {
    const Names passes = run(set_scene(), small(), [](Changed& now, int frame) {
        now.pose.light_instances[1].world_from_light[3].x += 0.05 * frame;
    });
    EXPECT_THAT(passes, Not(Contains("shadow map: Spot")));
    EXPECT_THAT(passes, Not(Contains("rsm: Spot")));
    EXPECT_THAT(passes, Contains("rsm: Lamp"));
    EXPECT_THAT(passes, Contains("ism disks"));
    EXPECT_THAT(passes, Not(Contains("gbuffer")));
    EXPECT_THAT(passes, Not(Contains("depth samples")));
}

TEST_F(Unchanged, ALightsPowerLeavesItsShadowMap) {
    const Names passes = run(set_scene(), small(), [](Changed& now, int frame) {
        now.pose.lights[0].power_w *= 1.0F + static_cast<float>(frame);
    });
    EXPECT_THAT(passes, Not(Contains("shadow map: Spot")));
    EXPECT_THAT(passes, Contains("direct light: Spot"));
}

TEST_F(Unchanged, AnObjectThatMovesIsSeenByAll) {
    const Names passes =
        run(set_scene(), small(), [](Changed& now, int frame) { move_ball(now.pose, 0.03 * frame); });
    for (const char* name : {"gbuffer", "shadow map: Spot", "points", "ism disks"}) {
        EXPECT_THAT(passes, Contains(name));
    }
}

TEST_F(Unchanged, AnObjectBesideALightsConeLeavesItsMaps) {
    scene::Scene scene = set_scene();
    scene::Light aside = scene.lights[0];
    aside.name = "Aside";
    aside.cone_angle_rad = 0.3F;
    add_light(scene, aside, moved({1.2, 1.2, 1.0}));  // looks down
    const Names passes =
        run(scene, small(), [](Changed& now, int frame) { move_ball(now.pose, 0.01 * frame); });
    EXPECT_THAT(passes, Contains("shadow map: Spot"));
    EXPECT_THAT(passes, Not(Contains("shadow map: Aside")));
    EXPECT_THAT(passes, Not(Contains("rsm: Aside")));
}

TEST_F(Unchanged, AMaterialThatChangesLeavesShadowMaps) {
    const Names passes = run(set_scene(), small(), [](Changed& now, int frame) {
        for (scene::Material& material : now.pose.materials) {
            material.base_color.r *= 1.0F - 0.2F * static_cast<float>(frame);
        }
    });
    EXPECT_THAT(passes, Not(Contains("shadow map: Spot")));
    EXPECT_THAT(passes, Contains("rsm: Spot"));
    EXPECT_THAT(passes, Contains("gbuffer"));
}

TEST_F(Unchanged, TheWorldsLightChangesAloneWithItsMaps) {
    const Names passes = run(set_scene(), small(), [](Changed& now, int frame) {
        now.pose.world.strength = 1.0F + static_cast<float>(frame);
    });
    EXPECT_THAT(passes, Not(Contains("rsm: Spot")));
    EXPECT_THAT(passes, Not(Contains("vpls")));
}

// Every way to draw bounced light, and every kind of shadow, with the camera moving, and with an object
// moving.
TEST_F(Unchanged, NoSettingsShowIt) {
    std::vector<std::pair<std::string, Settings>> all;
    const auto with = [&](const char* name, const std::function<void(Settings&)>& set) {
        Settings settings = small();
        set(settings);
        all.emplace_back(name, settings);
    };
    with("rsm", [](Settings& s) { s.technique = Technique::rsm; });
    with("direct", [](Settings& s) { s.technique = Technique::direct; });
    with("bounces", [](Settings& s) { s.bounces = 3; });
    with("irsm", [](Settings& s) {
        s.bounces = 2;
        s.bounce_source = BounceSource::irsm;
    });
    with("avg", [](Settings& s) {
        s.bounces = 2;
        s.bounce_source = BounceSource::avg;
        s.vpl_sampling = VplSampling::avg;
        s.near_field = false;
        s.avg_size = 32;
    });
    with("view", [](Settings& s) { s.vpl_importance = Importance::view; });
    with("metropolis", [](Settings& s) { s.vpl_sampling = VplSampling::metropolis; });
    with("drawn world", [](Settings& s) { s.world_sampling = WorldSampling::drawn; });
    with("points", [](Settings& s) {
        s.splat = Splat::points;
        s.pull_push = PullPush::paper;
    });
    with("tessellation", [](Settings& s) { s.splat = Splat::tessellation; });
    with("classic maps", [](Settings& s) { s.visibility = Visibility::shadow_maps; });
    with("simplified", [](Settings& s) { s.visibility = Visibility::simplified; });
    with("hybrid", [](Settings& s) { s.shading = Shading::hybrid; });
    with("convolution", [](Settings& s) { s.direct_shadows = DirectShadows::convolution; });
    with("imperfect shadows", [](Settings& s) { s.direct_shadows = DirectShadows::ism; });
    const scene::Scene scene = set_scene();
    for (const auto& [name, settings] : all) {
        SCOPED_TRACE(name);
        run(
            scene, settings,
            [](Changed& now, int frame) {
                k_camera(now, frame);
                if (frame == 2) move_ball(now.pose, 0.1);
            },
            true);
    }
}

TEST_F(Unchanged, AMorphThatRestsIsNotDeformedAgain) {
    scene::Scene scene = set_scene();
    scene::Mesh& ball = scene.meshes.back();
    scene::MorphTarget target;
    target.positions.assign(ball.primitives[0].positions.size(), glm::vec3(0.1F, 0.0F, 0.2F));
    ball.primitives[0].targets = {target};
    ball.primitives[0].bounds = scene::primitive_bounds(ball.primitives[0]);
    ball.weights = {0.0F};
    const auto node = std::find_if(scene.nodes.begin(), scene.nodes.end(), [&](const scene::Node& n) {
        return n.mesh == static_cast<int>(scene.meshes.size()) - 1;
    });
    const auto index = static_cast<size_t>(node - scene.nodes.begin());
    const Names resting = run(scene, small(), [&](Changed& now, int frame) {
        now.pose.weights[index] = {0.5F};
        k_camera(now, frame);
    });
    EXPECT_THAT(resting, Not(AnyOf(Contains("deform"), Contains("points"), Contains("ism disks"))));
    const Names moving = run(scene, small(), [&](Changed& now, int frame) {
        now.pose.weights[index] = {0.2F * static_cast<float>(frame)};
    });
    EXPECT_THAT(moving, Contains("deform"));
    EXPECT_THAT(moving, Contains("ism disks"));
}

// ---- forced ----

TEST_F(Unchanged, ForcingWhatIsExactChangesNoBit) {
    for (const bool from_blender : {true, false}) {
        scene::Scene scene = set_scene();
        scene.from_blender = from_blender;
        Settings settings = small();
        const CameraView camera = camera_from_above(4.0, 10.0);
        const Rendered plain = draw(scene, camera, settings);
        settings.forced = Forced::exact;
        const Rendered forced = draw(scene, camera, settings);
        EXPECT_EQ(plain.image.rgb, forced.image.rgb);
        EXPECT_GT(forced.report.executed.size(), plain.report.executed.size());
        EXPECT_THAT(forced.report.executed, Contains("over, layer 1"));
    }
}

TEST_F(Unchanged, ForcingEstimatesStaysWithinTheirBound) {
    scene::Scene scene = set_scene();
    scene.world.color = glm::vec3(0.0F);
    Settings settings = small();
    settings.interleave = 4;
    settings.vpls = 256;
    settings.world_vpls = 64;
    const CameraView camera = camera_from_above(4.0, 10.0);
    const Rendered plain = draw(scene, camera, settings);
    settings.forced = Forced::all;
    const Rendered forced = draw(scene, camera, settings);
    EXPECT_THAT(forced.report.executed, Contains("soft shadow: Lamp"));
    EXPECT_GT(std::count(forced.report.executed.begin(), forced.report.executed.end(), "ism disks"),
              std::count(plain.report.executed.begin(), plain.report.executed.end(), "ism disks"));
    // Other points in the maps of bounced light: its own sampling error, docs/leaving_out.md.
    EXPECT_LT(relmse(forced.image, plain.image), 0.01);
}

TEST_F(Unchanged, DarkSurfacesHaveNoFurtherBounces) {
    scene::Scene scene = set_scene();
    scene.world.color = glm::vec3(0.0F);
    for (scene::Material& material : scene.materials) {
        material.base_color = glm::vec4(0.02F, 0.01F, 0.02F, 1.0F);
        material.specular = 0.0F;
    }
    Settings settings = small();
    settings.bounces = 3;
    const CameraView camera = camera_from_above(4.0, 10.0);
    const Rendered plain = draw(scene, camera, settings);
    EXPECT_THAT(plain.report.executed, Contains("vpls"));
    EXPECT_THAT(plain.report.executed, Not(Contains("vpls, next bounce")));
    settings.forced = Forced::all;
    const Rendered forced = draw(scene, camera, settings);
    EXPECT_THAT(forced.report.executed, Contains("vpls, next bounce"));
    EXPECT_NEAR(plain.mean() / forced.mean(), 1.0, 1e-3 + 1e-3) << "the bound, and the maps' other points";
}

// ---- memory ----

TEST_F(Unchanged, MemoryIsWhatWasForecast) {
    const scene::Scene scene = set_scene();
    const CameraView camera = camera_from_above(4.0, 10.0);
    const scene::Pose pose = scene::evaluate_pose(scene, 0.0);
    for (const bool keeps : {false, true}) {
        const size_t before = gl::allocated_bytes();
        Renderer renderer(scene);
        renderer.expect_frames(keeps);
        const FrameReport::Memory forecast = renderer.plan(pose, camera, small()).memory.value();
        gl::restart_peak();
        (void)renderer.render(pose, camera, small());
        const auto measured = static_cast<double>(gl::peak_allocated_bytes());
        (void)before;
        EXPECT_NEAR(static_cast<double>(forecast.peak()) / measured, 1.0, 0.02);
        renderer.keep_frame();
    }
}

TEST_F(Unchanged, AMemoryLimitIsKeptOrRefused) {
    const scene::Scene scene = set_scene();
    Settings large = small();
    large.shadow_size = 1024;
    large.soft_shadow_size = 256;
    const CameraView camera = camera_from_above(4.0, 10.0);
    const scene::Pose pose = scene::evaluate_pose(scene, 0.0);
    const MomentAt at = [&](size_t, const auto& visit) { visit({pose, camera}); };
    Renderer renderer(scene);
    const MemoryFit all = fit_to_memory(renderer, 1, at, large, true, size_t{1} << 40U);
    EXPECT_TRUE(all.changes.empty());
    EXPECT_TRUE(all.keeps);
    const size_t limit = all.peak_bytes / 2;
    Renderer limited(scene);
    gl::restart_peak();
    const MemoryFit fit = fit_to_memory(limited, 1, at, large, true, limit);
    EXPECT_FALSE(fit.changes.empty());
    EXPECT_LE(fit.peak_bytes, limit);
    (void)limited.render(pose, camera, fit.settings);
    EXPECT_LE(gl::peak_allocated_bytes(), limit + all.peak_bytes) << "the first renderer is there as well";
    EXPECT_THAT([&] { (void)fit_to_memory(limited, 1, at, large, true, 1000); },
                ThrowsMessage<Error>(HasSubstr("raise --memory-limit")));
}

}  // namespace
}  // namespace bounce::test
