// SPDX-License-Identifier: Apache-2.0
//
// Evaluations that fail, are killed, or find no room: what is said, and what is kept.
#include <fstream>

#include <gtest/gtest.h>

#include "core/error.h"
#include "evaluate_fixture.h"
#include "file_size_limit.h"
#include "triangle_gltf.h"

namespace bounce {
namespace {

using test::Environment;
using test::EvaluateTest;

// The program fails at its third call: the two points before are kept, and the next run draws the third
// alone.
TEST_F(EvaluateTest, AKilledSweepGoesOnWhereItStopped) {
    const std::filesystem::path whole = options_.bounce;
    options_.point_folder = folder_ / "points";
    options_.resume = true;
    options_.runs[1].render_arguments = {"--vpls", "64"};
    options_.runs[2].render_arguments = {"--vpls", "128"};
    // One program, so that its hash stays: it ends where the file `kill` is there and two calls were made.
    options_.bounce = test::write_script(
        folder_ / "killable",
        "#!/bin/sh\ncd '" + folder_.path().string() +
            "'\n[ -e kill ] && [ -e bounce_calls ] && [ $(wc -l < bounce_calls) -ge 2 ] && exit 137\n"
            "exec '" +
            whole.string() + "' \"$@\"\n");
    std::ofstream(folder_ / "kill") << "";
    EXPECT_THROW((void)evaluate(options_), Error);
    EXPECT_EQ(calls("bounce_calls"), 2);
    std::filesystem::remove(folder_ / "kill");
    const Evaluation result = evaluate(options_);
    EXPECT_EQ(calls("bounce_calls"), 3);
    EXPECT_EQ(result.curves[2].points.size(), 2U);
    (void)evaluate(options_);
    EXPECT_EQ(calls("bounce_calls"), 3) << "all points are there";
    options_.resume = false;
    (void)evaluate(options_);
    EXPECT_EQ(calls("bounce_calls"), 6) << "measured afresh unless told otherwise";
    options_.resume = true;
    std::ofstream(folder_ / "scene.glb") << "another scene";
    (void)evaluate(options_);
    EXPECT_EQ(calls("bounce_calls"), 9);
}

TEST_F(EvaluateTest, BouncesFailureComesBeforeCyclesStarts) {
    options_.bounce = test::write_script(folder_ / "broken", "#!/bin/sh\necho 'error: no OpenGL'\nexit 4\n");
    try {
        (void)evaluate(options_);
        FAIL() << "evaluated";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::no_opengl);
    }
    EXPECT_EQ(calls("blender_calls"), 0);
}

TEST_F(EvaluateTest, CyclesFailureIsASentence) {
    options_.source.blender = test::write_script(
        folder_ / "failing",
        "#!/bin/sh\n[ \"$1\" = --version ] && { echo Blender 9.9.9; exit 0; }\n"
        "echo 'BOUNCE {\"event\": \"error\", \"message\": \"the scene has no active camera\"}'\nexit 1\n");
    try {
        (void)evaluate(options_);
        FAIL() << "evaluated";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_refused);
        EXPECT_NE(std::string(error.what()).find("scene.glb: the scene has no active camera"),
                  std::string::npos);
    }
}

TEST_F(EvaluateTest, AMissingDracoLibraryIsToldBeforeAnythingIsDrawn) {
    const Environment none("BLENDER_EXTERN_DRACO_LIBRARY_PATH", "");
    options_.scene =
        test::write_triangle(folder_ / "scene.gltf", {{"extensionsUsed", {"KHR_draco_mesh_compression"}}});
    try {
        (void)evaluate(options_);
        FAIL() << "evaluated";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::failed);
        EXPECT_NE(std::string(error.what()).find("build the target extern_draco"), std::string::npos);
    }
    EXPECT_EQ(calls("bounce_calls") + calls("blender_calls"), 0);
    std::filesystem::create_directories(folder_ / "build/release");
    std::ofstream(folder_ / "build/release/libextern_draco.so") << "a library";
    EXPECT_FALSE(evaluate(options_).references[0].cached);
    std::filesystem::remove_all(folder_ / "build");
    EXPECT_TRUE(evaluate(options_).references[0].cached) << "what is finished needs no Draco";
}

TEST_F(EvaluateTest, AProgramThatIsNotBlenderIsRefused) {
    options_.source.blender = test::write_script(folder_ / "other", "#!/bin/sh\necho hello\n");
    EXPECT_THROW((void)evaluate(options_), Error);
}

// Stopped behind three of four renders, first of Cycles' points and then of the references' halves.
TEST_F(EvaluateTest, GoesOnWhereItStopped) {
    options_.point_folder = folder_ / "report/points";
    options_.resume = true;
    std::ofstream(folder_ / "cycles_fail_after") << 3;
    EXPECT_THROW((void)evaluate(options_), Error);
    EXPECT_EQ(calls("bounce_calls"), 3);
    std::filesystem::remove(folder_ / "cycles_fail_after");
    const Evaluation result = evaluate(options_);
    EXPECT_EQ(calls("bounce_calls"), 3) << "the runs were there";
    EXPECT_EQ(calls("pass_calls"), 3) << "their passes are timed at the end";
    EXPECT_DOUBLE_EQ(result.curves[1].points[0].seconds, 0.020);
    EXPECT_EQ(result.curves[1].points[0].rss_peak_bytes, 8U);
    std::vector<std::string> jobs = blender_jobs();
    ASSERT_EQ(jobs.size(), 3U) << "the points twice, then the references";
    EXPECT_NE(jobs[0].find("cycles_1_1.exr"), std::string::npos);
    for (const char* finished : {"cycles_1_1.exr", "cycles_1_4.exr", "cycles_24_1.exr"}) {
        EXPECT_EQ(jobs[1].find(finished), std::string::npos) << finished;
    }
    EXPECT_NE(jobs[1].find("cycles_24_4.exr"), std::string::npos);

    options_.reference.spp = 64;
    std::ofstream(folder_ / "cycles_fail_after") << 3;
    EXPECT_THROW((void)evaluate(options_), Error);
    std::filesystem::remove(folder_ / "cycles_fail_after");
    EXPECT_EQ(evaluate(options_).references[1].spp, 64);
    jobs = blender_jobs();
    ASSERT_EQ(jobs.size(), 5U);
    EXPECT_NE(jobs[3].find("24_1.exr"), std::string::npos);
    EXPECT_EQ(jobs[4].find("\"frame\": 1,"), std::string::npos) << "the first frame's reference is whole";
    EXPECT_EQ(jobs[4].find("24_1.exr"), std::string::npos) << "half of the second's is kept";
    EXPECT_NE(jobs[4].find("24_2.exr"), std::string::npos);

    // Another program is another measurement.
    std::ofstream(options_.bounce, std::ios::app) << "# changed\n";
    (void)evaluate(options_);
    EXPECT_EQ(calls("bounce_calls"), 3 + 3);
}

// First of Cycles' points, then of the references' halves.
TEST_F(EvaluateTest, APictureThatWasCutOffIsNotTheEndOfTheOthers) {
    const auto failure = [&] {
        try {
            (void)evaluate(options_);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::failed);
            return std::string(error.what());
        }
        return std::string();
    };
    options_.point_folder = folder_ / "report/points";
    options_.resume = true;
    for (const int spp : {4, 16}) {
        std::ofstream(folder_ / "cycles_cut") << spp;
        const size_t before = blender_jobs().size();
        EXPECT_NE(failure().find("a picture of Cycles is damaged"), std::string::npos) << spp;
        EXPECT_LE(blender_jobs().size(), before + 2) << "it was rendered again and again";
    }
    std::filesystem::remove(folder_ / "cycles_cut");
    EXPECT_EQ(evaluate(options_).references.size(), 2U);
    const std::vector<std::string> jobs = blender_jobs();
    ASSERT_EQ(jobs.size(), 4U);
    EXPECT_EQ(jobs[1].find("cycles_1_1.exr"), std::string::npos) << "whole pictures are kept";
    EXPECT_NE(jobs[1].find("cycles_24_4.exr"), std::string::npos);
}

TEST_F(EvaluateTest, NoRoomForPicturesIsASentence) {
    std::ofstream(folder_ / "cycles_cut") << 4;
    const test::FileSizeLimit limit(
        60000);  // less than the room that a picture is given, more than anything here
    try {
        (void)evaluate(options_);
        FAIL() << "evaluated";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::failed);
        EXPECT_NE(std::string(error.what()).find("there is no room for temporary files in"),
                  std::string::npos);
    }
}

TEST_F(EvaluateTest, ACacheThatTakesNothingIsNotTheEnd) {
    std::filesystem::create_directories(folder_ / "cache/bounce");
    for (const char* name : {"references", "renders"}) {
        std::ofstream(folder_ / "cache/bounce" / name) << "not a folder";
    }
    const Evaluation result = evaluate(options_);
    EXPECT_EQ(result.references[1].spp, 32);
    EXPECT_FALSE(result.references[1].cached);
}

}  // namespace
}  // namespace bounce
