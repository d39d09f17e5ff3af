// SPDX-License-Identifier: Apache-2.0
#include "evaluate/evaluation.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "environment.h"
#include "evaluate/report.h"
#include "fake_programs.h"
#include "file_size_limit.h"
#include "temporary_folder.h"
#include "triangle_gltf.h"

namespace bounce {
namespace {

using test::Environment;
using test::TemporaryFolder;

class EvaluateTest : public testing::Test {
  protected:
    EvaluateTest()
        : cache_("XDG_CACHE_HOME", (folder_ / "cache").string()),
          addon_("BOUNCE_ADDON", (folder_ / "addon").string()) {
        std::filesystem::create_directories(folder_ / "addon");
        std::ofstream(folder_ / "addon/export_cli.py") << "#\n";
        std::ofstream(folder_ / "scene.glb") << "the scene";
        test::write_constant(folder_ / "picture.exr", 0.6F, 8, 4);
        test::write_constant(folder_ / "cycles.exr", 0.5F, 8, 4);
        options_.scene = folder_ / "scene.glb";
        options_.frames = {1, 24};
        options_.width = 8;
        options_.height = 4;
        options_.reference.spp = 32;
        options_.cycles_spp = {1, 4};
        options_.bounce = test::fake_bounce(folder_.path());
        options_.source.blender = test::fake_blender(folder_.path());
        options_.runs = {
            {"Direct", "direct", {"--technique", "direct"}}, {"RSM", "112", {}}, {"RSM", "224", {}}};
    }

    [[nodiscard]] long calls(const std::string& name) const {
        std::ifstream in(folder_ / name);
        return std::count(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>(), '\n');
    }

    // The description of each job that Blender was started with, in order.
    [[nodiscard]] std::vector<std::string> blender_jobs() const {
        std::ifstream in(folder_ / "blender_calls");
        std::vector<std::string> jobs;
        for (std::string line; std::getline(in, line);) jobs.push_back(line);
        return jobs;
    }

    TemporaryFolder folder_;
    Environment cache_;
    Environment addon_;
    EvaluateOptions options_;
};

TEST_F(EvaluateTest, MeasuresEveryRunAgainstTheReference) {
    const Evaluation result = evaluate(options_);
    ASSERT_EQ(result.curves.size(), 3U);
    EXPECT_EQ(result.curves[0].name, "Cycles");
    EXPECT_TRUE(result.curves[0].reference_engine);
    ASSERT_EQ(result.curves[0].points.size(), 2U);
    EXPECT_DOUBLE_EQ(result.curves[0].points[1].seconds, 8.0);
    EXPECT_EQ(result.curves[2].points.size(), 2U) << "runs of one name are one curve";
    const CurvePoint& direct = result.curves[1].points[0];
    // 0.6 as half against 0.5: 0.1^2 / (0.5^2 + 0.01).
    EXPECT_NEAR(direct.relmse, 0.01 / 0.26, 1e-4);
    EXPECT_NEAR(direct.bias, 0.2, 1e-3);
    EXPECT_DOUBLE_EQ(direct.seconds, 0.020);
    ASSERT_EQ(direct.frames.size(), 2U);
    EXPECT_EQ(direct.frames[1].frame, 24);
    EXPECT_EQ(result.cycles.version, "9.9.9");
    EXPECT_EQ(result.references[0].seconds, 64.0);
    EXPECT_EQ(result.references[0].noise_floor, 0.0);
    EXPECT_DOUBLE_EQ(result.cycles.first_render_seconds, 3.0);
}

TEST_F(EvaluateTest, RendersAReferenceOnce) {
    EXPECT_FALSE(evaluate(options_).references[0].cached);
    const Evaluation again = evaluate(options_);
    EXPECT_TRUE(again.references[0].cached);
    EXPECT_EQ(again.references[0].seconds, 64.0) << "its time is remembered";
    const std::vector<std::string> jobs = blender_jobs();
    ASSERT_GE(jobs.size(), 2U);
    EXPECT_NE(jobs[1].find("\"spp\": 16"), std::string::npos);
    EXPECT_EQ(jobs.size(), 2U) << "the points and the halves of the references, each once";
    EXPECT_EQ(again.cycles.version, "9.9.9");
    EXPECT_FALSE(again.curves[0].points[0].measured.empty()) << "an earlier run's time is told as such";
    EXPECT_TRUE(again.curves[1].points[0].measured.empty()) << "Bounce is measured anew";
    options_.fresh = true;
    const Evaluation fresh = evaluate(options_);
    EXPECT_TRUE(fresh.curves[0].points[0].measured.empty());
    EXPECT_TRUE(fresh.references[0].cached);
    options_.fresh = false;

    std::ofstream(folder_ / "scene.glb") << "another scene";
    EXPECT_FALSE(evaluate(options_).references[0].cached);
}

TEST_F(EvaluateTest, TheSecondTimeHasTheErrorsOfTheFirst) {
    test::write_constant(folder_ / "cycles.exr", 0.3F, 8, 4);  // not a half float
    test::write_constant(folder_ / "picture.exr", 0.7F, 8, 4);
    const Evaluation first = evaluate(options_);
    const Evaluation second = evaluate(options_);
    ASSERT_TRUE(second.references[0].cached);
    for (size_t i = 0; i < first.curves.size(); ++i) {
        for (size_t k = 0; k < first.curves[i].points.size(); ++k) {
            const CurvePoint& a = first.curves[i].points[k];
            const CurvePoint& b = second.curves[i].points[k];
            EXPECT_EQ(a.relmse, b.relmse) << a.label;
            EXPECT_EQ(a.flip_ldr, b.flip_ldr) << a.label;
            EXPECT_EQ(a.bias, b.bias) << a.label;
        }
    }
    EXPECT_EQ(first.references[0].noise_floor, second.references[0].noise_floor);
}

TEST_F(EvaluateTest, SpreadAndOptionsOfEachPoint) {
    const Evaluation result = evaluate(options_);
    const CurvePoint& direct = result.curves[1].points[0];
    EXPECT_DOUBLE_EQ(direct.seconds_least, 0.020);
    EXPECT_DOUBLE_EQ(direct.seconds_most, 0.030);
    // Cycles' quick points are rendered three times; an earlier run's spread is kept with its time.
    for (const Evaluation& run : {result, evaluate(options_)}) {
        EXPECT_DOUBLE_EQ(run.curves[0].points[1].seconds_least, 6.0);
        EXPECT_DOUBLE_EQ(run.curves[0].points[1].seconds_most, 16.0);
    }
    EXPECT_EQ(direct.options, options_.runs[0].render_arguments);
    EXPECT_TRUE(result.curves[0].points[0].options.empty()) << "Cycles has none";
}

TEST_F(EvaluateTest, EachRoundMeasuresEveryRun) {
    options_.rounds = 2;
    const Evaluation result = evaluate(options_);
    EXPECT_EQ(calls("bounce_calls"), 6);
    ASSERT_EQ(result.curves.size(), 3U);
    EXPECT_EQ(result.curves[2].points.size(), 2U);
    EXPECT_DOUBLE_EQ(result.curves[1].points[0].seconds, 0.020);
}

TEST_F(EvaluateTest, AGivenReferenceNeedsNoBlender) {
    test::write_constant(folder_ / "ref.0001.exr", 0.5F, 8, 4);
    test::write_constant(folder_ / "ref.0024.exr", 0.6F, 8, 4);
    options_.given_reference = (folder_ / "ref.####.exr").string();
    options_.cycles_spp.clear();
    options_.source.blender = folder_ / "no_blender";
    const Evaluation result = evaluate(options_);
    ASSERT_EQ(result.curves.size(), 2U);
    EXPECT_EQ(result.curves[0].name, "Direct");
    EXPECT_NEAR(result.curves[0].points[0].frames[0].relmse, 0.01 / 0.26, 1e-4);
    EXPECT_EQ(result.curves[0].points[0].frames[1].relmse, 0.0);
    EXPECT_TRUE(result.speedups.empty());
    write_report(result, folder_ / "report");
    EXPECT_TRUE(std::filesystem::is_regular_file(folder_ / "report/results.json"));

    options_.width = 16;
    EXPECT_THROW((void)evaluate(options_), Error);
    EXPECT_EQ(calls("bounce_calls"), 3) << "a wrong size is refused before anything is drawn";
}

// Pictures of 0.55 and 0.45 in turn against 0.5, as half floats: (0.05 / 0.5)^2, and 0.1 from frame to frame.
TEST_F(EvaluateTest, FramesInARowAreASequence) {
    test::write_constant(folder_ / "ref.exr", 0.5F, 8, 4);
    for (int frame = 1; frame <= 8; ++frame) {
        test::write_constant(folder_ / ("picture.000" + std::to_string(frame) + ".exr"),
                             frame % 2 == 0 ? 0.55F : 0.45F, 8, 4);
    }
    Image still(8, 4);
    for (size_t i = 2; i < still.rgb.size(); i += 3) still.rgb[i] = 5.0F;
    write_image(folder_ / "motion.exr", still);
    options_.given_reference = (folder_ / "ref.exr").string();
    options_.cycles_spp.clear();
    options_.frames = {1, 2, 3, 4, 5, 6, 7, 8};
    const Evaluation result = evaluate(options_);
    EXPECT_EQ(result.sequence_step, 1);
    EXPECT_TRUE(result.motion);
    EXPECT_EQ(calls("motion_calls"), 1) << "once for all points";
    for (const Curve& curve : result.curves) {
        for (const CurvePoint& point : curve.points) {
            ASSERT_TRUE(point.sequence) << point.label;
            EXPECT_NEAR(point.sequence->flicker_power, 0.01, 1e-4);
            EXPECT_NEAR(point.sequence->tid, 0.1, 1e-3);
            EXPECT_TRUE(std::isfinite(point.flip_hdr));
        }
    }
    const size_t shown = shown_points(result).size();
    EXPECT_EQ(result.pictures.size(), 8 * shown) << "others are not kept in memory";
    options_.frames = {1};
    const Evaluation one = evaluate(options_);
    EXPECT_EQ(one.sequence_step, 0);
    EXPECT_FALSE(one.curves[0].points[0].sequence);
    EXPECT_EQ(calls("motion_calls"), 1) << "a frame alone costs nothing more";
}

TEST_F(EvaluateTest, AGivenReferenceAndALadder) {
    test::write_constant(folder_ / "ref.exr", 0.5F, 8, 4);
    options_.given_reference = (folder_ / "ref.exr").string();
    const Evaluation result = evaluate(options_);
    EXPECT_EQ(result.curves[0].name, "Cycles");
    std::ifstream in(folder_ / "blender_calls");
    std::string job;
    std::getline(in, job);
    EXPECT_EQ(job.find("\"spp\": 16"), std::string::npos) << "half a reference was rendered";
}

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

TEST_F(EvaluateTest, AChangedBufferBesideAFileMakesAnotherReference) {
    options_.scene = test::write_triangle(folder_ / "scene.gltf");
    EXPECT_FALSE(evaluate(options_).references[0].cached);
    EXPECT_TRUE(evaluate(options_).references[0].cached);
    {
        const float x = 3.6F;  // of the third corner, from 3.2: the box, and so the framing, stays
        std::fstream data(folder_ / "triangle.bin", std::ios::in | std::ios::out | std::ios::binary);
        data.seekp(24);
        data.write(reinterpret_cast<const char*>(&x), sizeof x);
    }
    const Evaluation changed = evaluate(options_);
    EXPECT_FALSE(changed.references[0].cached);
    EXPECT_TRUE(changed.curves[0].points[0].measured.empty()) << "Cycles' own points as well";
}

TEST_F(EvaluateTest, BlenderIsToldWhatBounceShowsWhereAFileSaysNothing) {
    options_.scene = test::write_triangle(folder_ / "scene.gltf");
    (void)evaluate(options_);
    const auto job = nlohmann::json::parse(blender_jobs().front());
    EXPECT_EQ(job["defaults"]["cameras"].size(), 2U) << "one a frame";
    EXPECT_GT(job["defaults"]["world"]["strength"], 0.0);
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

TEST_F(EvaluateTest, LooksIntoTheFrames) {
    const Evaluation result = evaluate(options_);
    ASSERT_EQ(result.passes.size(), 3U);
    EXPECT_EQ(result.passes[0].passes[0].name, "gbuffer");
    EXPECT_DOUBLE_EQ(result.passes[0].passes[0].seconds, 0.005);
    EXPECT_DOUBLE_EQ(result.passes[0].passes[0].seconds_least, 0.004);
    EXPECT_DOUBLE_EQ(result.passes[0].passes[0].seconds_most, 0.009);
    EXPECT_EQ(result.passes[0].left_out[0].reason, "nothing moves");
    ASSERT_EQ(result.startups.size(), 2U);
    EXPECT_EQ(result.startups[0].engine, "Bounce");
    EXPECT_GT(result.startups[0].start_seconds, 0.040);
    EXPECT_DOUBLE_EQ(result.startups[0].load_seconds, 0.250);
    EXPECT_DOUBLE_EQ(result.startups[0].first_render_seconds, 0.070);
    EXPECT_EQ(result.startups[1].first_render_seconds, 3.0);
}

TEST_F(EvaluateTest, WritesAWholeReport) {
    write_report(evaluate(options_), folder_ / "report");
    for (const char* name : {"results.json", "results.csv", "index.html", "frames/reference.0024.exr",
                             "frames/rsm_112.0001.exr"}) {
        EXPECT_TRUE(std::filesystem::is_regular_file((folder_ / "report") / name)) << name;
    }
}

}  // namespace
}  // namespace bounce
