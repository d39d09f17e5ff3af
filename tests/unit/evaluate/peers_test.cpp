// SPDX-License-Identifier: Apache-2.0
#include "evaluate/peers.h"

#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "environment.h"
#include "evaluate/f3d_runner.h"
#include "fake_programs.h"
#include "temporary_folder.h"

namespace bounce {
namespace {

using test::Environment;
using test::TemporaryFolder;
using testing::HasSubstr;
namespace fs = std::filesystem;

class PeersTest : public testing::Test {
  protected:
    PeersTest()
        : path_("PATH", (folder_ / "bin").string() + ":/usr/bin:/bin"),
          display_("DISPLAY", ":99"),
          addon_("BOUNCE_ADDON", (folder_ / "addon").string()) {
        fs::create_directories(folder_ / "bin");
        fs::create_directories(folder_ / "addon");
        std::ofstream(folder_ / "addon/export_cli.py") << "#\n";
        std::ofstream(folder_ / "scene.glb") << "the scene";
        test::write_constant(folder_ / "peer.exr", 0.5F, 8, 4);
        test::write_constant(folder_ / "peer.png", 0.5F, 8, 4);
        job_.scene = folder_ / "scene.glb";
        job_.scene_hash = "scene";
        job_.blender = test::fake_peer_blender(folder_.path());
        job_.blender_version = "Blender 9.9.9";
        job_.frames = {1, 24};
        job_.width = 8;
        job_.height = 4;
        job_.cache = folder_ / "cache";
    }

    PeerResult run(const std::string& name) {
        return run_peer(name, job_, [&](const std::string& line) { progress_.push_back(line); });
    }

    [[nodiscard]] std::string text_of(const std::string& name) const {
        std::ifstream in(folder_ / name);
        return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    }

    TemporaryFolder folder_;
    Environment path_;
    Environment display_;
    Environment addon_;
    PeerJob job_;
    std::vector<std::string> progress_;
};

TEST_F(PeersTest, EeveeRendersThreeSampleCounts) {
    const PeerResult result = run("eevee");
    EXPECT_TRUE(result.left_out.empty()) << result.left_out.front();
    ASSERT_EQ(result.points.size(), 3U);
    EXPECT_EQ(result.points[0].label, "1 sample");
    EXPECT_EQ(result.points[2].label, "64 samples");
    ASSERT_EQ(result.points[2].frames.size(), 2U);
    EXPECT_EQ(result.points[2].frames[1].frame, 24);
    EXPECT_EQ(result.points[2].frames[1].render.seconds, 6.4);
    EXPECT_EQ(result.points[0].frames[0].render.first_render_seconds, 7.0);
    EXPECT_EQ(result.points[0].frames[0].render.rss_peak_bytes, 12345U);
    // Film exposure 2 is Cycles' alone.
    EXPECT_NEAR(result.points[0].frames[0].render.image.rgb[0], 1.0F, 1e-3);
    EXPECT_THAT(result.notes, testing::ElementsAre(HasSubstr("film exposure")));
    EXPECT_EQ(progress_.size(), 6U);
}

TEST_F(PeersTest, EeveeIsRenderedOnceUnlessFresh) {
    (void)run("eevee");
    fs::remove(folder_ / "peer_calls");
    const PeerResult again = run("eevee");
    EXPECT_FALSE(fs::exists(folder_ / "peer_calls")) << "Blender was started for nothing";
    ASSERT_EQ(again.points.size(), 3U);
    EXPECT_TRUE(again.points[0].frames[0].cached);
    EXPECT_EQ(again.points[2].frames[0].render.seconds, 6.4);
    EXPECT_EQ(again.points[2].frames[0].render.all_seconds.size(), 3U);
    EXPECT_THAT(again.notes, testing::ElementsAre(HasSubstr("film exposure")));
    job_.fresh = true;
    EXPECT_FALSE(run("eevee").points[0].frames[0].cached);
}

// Killed after some pictures: the next run asks for the others alone.
TEST_F(PeersTest, EeveeGoesOnWhereItStopped) {
    std::ofstream(folder_ / "fail_after") << 2;
    const PeerResult broken = run("eevee");
    EXPECT_THAT(broken.left_out,
                testing::ElementsAre(HasSubstr("Eevee is left out: Blender ended with code 1")));
    EXPECT_TRUE(broken.points.empty()) << "no point has both frames";
    fs::remove(folder_ / "fail_after");
    fs::remove(folder_ / "peer_calls");
    const PeerResult whole = run("eevee");
    EXPECT_EQ(whole.points.size(), 3U);
    EXPECT_TRUE(whole.points[0].frames[0].cached);
    const std::string calls = text_of("peer_calls");
    EXPECT_THAT(calls, testing::Not(HasSubstr("eevee_1_1.exr")));
    EXPECT_THAT(calls, HasSubstr("eevee_1_64.exr"));
    EXPECT_THAT(calls, HasSubstr("eevee_24_1.exr"));
}

TEST_F(PeersTest, WhatTakesTooLongIsASentence) {
    std::ofstream(folder_ / "skip") << 64;
    const PeerResult result = run("eevee");
    ASSERT_EQ(result.points.size(), 2U);
    EXPECT_THAT(result.left_out,
                testing::ElementsAre(testing::AllOf(HasSubstr("64 samples"), HasSubstr("--peer-limit"))));
}

TEST_F(PeersTest, WithoutADisplayThePackageIsNamed) {
    const Environment no_display("DISPLAY", "");
    const Environment no_programs("PATH", (folder_ / "bin").string());
    EXPECT_THAT(run("eevee").left_out, testing::ElementsAre(HasSubstr("install Debian's package xvfb")));
    EXPECT_THAT(run("f3d").left_out, testing::ElementsAre(HasSubstr("install Debian's package f3d")));
}

TEST_F(PeersTest, F3dTimesTheDifferenceOfTwoRuns) {
    test::fake_f3d(folder_.path());
    job_.frames = {1};
    const PeerResult result = run("f3d");
    EXPECT_TRUE(result.left_out.empty()) << result.left_out.front();
    ASSERT_EQ(result.points.size(), 2U);
    const CachedRender& render = result.points[0].frames[0].render;
    // The stand-in takes 5 ms a frame beside 100 ms of start.
    EXPECT_GT(render.seconds, 0.003);
    EXPECT_LT(render.seconds, 0.02);
    EXPECT_GT(render.startup_seconds, 0.05);
    // Load ends before the window opens.
    EXPECT_GT(render.first_render_seconds, 0.0);
    EXPECT_GT(render.startup_seconds - render.first_render_seconds, 0.04);
    EXPECT_EQ(render.export_seconds, 0.25);
    // 0.5 on the screen (128/255) is 0.2159 of light.
    EXPECT_NEAR(render.image.rgb[0], 0.2159F, 1e-3);
    const std::string calls = text_of("f3d_calls");
    EXPECT_THAT(calls,
                HasSubstr("--camera-position=1,2,3.5 --camera-focal-point=0,0,0 --camera-view-up=0,1,0"));
    EXPECT_THAT(calls, HasSubstr("--camera-view-angle=30.5"));
    EXPECT_THAT(calls, HasSubstr("--resolution=8,4"));
    fs::remove(folder_ / "f3d_calls");
    EXPECT_TRUE(run("f3d").points[1].frames[0].cached);
    EXPECT_FALSE(fs::exists(folder_ / "f3d_calls"));
}

TEST_F(PeersTest, F3dSaysWhyItCannotTakeTheCamera) {
    test::fake_f3d(folder_.path());
    std::ofstream(folder_ / "bad_camera")
        << "f3d's options take a perspective camera, and the scene's is not one";
    const PeerResult result = run("f3d");
    EXPECT_TRUE(result.points.empty());
    EXPECT_THAT(result.left_out,
                testing::ElementsAre(
                    "f3d is left out: f3d's options take a perspective camera, and the scene's is not one"));
}

TEST_F(PeersTest, F3dOfAnotherSizeIsLeftOut) {
    test::fake_f3d(folder_.path());
    test::write_constant(folder_ / "peer.png", 0.5F, 16, 4);
    EXPECT_THAT(run("f3d").left_out, testing::ElementsAre(HasSubstr("f3d drew 16 x 4 pixels, not 8 x 4")));
}

TEST(F3dPresses, IsARecordThatEachLineOfDrawsAFrame) {
    const std::string record = f3d_presses(3);
    EXPECT_EQ(std::count(record.begin(), record.end(), '\n'), 4);
    EXPECT_THAT(record, testing::StartsWith("# StreamVersion"));
}

}  // namespace
}  // namespace bounce
