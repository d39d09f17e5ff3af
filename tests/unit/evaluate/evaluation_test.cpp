// SPDX-License-Identifier: Apache-2.0
#include "evaluate/evaluation.h"

#include <cmath>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "evaluate/report.h"
#include "evaluate_fixture.h"
#include "triangle_gltf.h"

namespace bounce {
namespace {

using test::EvaluateTest;

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

// The scene's own light paths give 0.75 where Bounce's give 0.5: against it the reference is a third too
// dark.
TEST_F(EvaluateTest, TheFinalRenderIsASecondReference) {
    EXPECT_FALSE(evaluate(options_).final_render);
    test::write_constant(folder_ / "cycles_own.exr", 0.75F, 8, 4);
    options_.final_render = true;
    const Evaluation result = evaluate(options_);
    ASSERT_TRUE(result.final_render);
    ASSERT_EQ(result.final_render->references.size(), 2U);
    EXPECT_EQ(result.final_render->references[1].frame, 24);
    EXPECT_FLOAT_EQ(result.final_render->references[0].image.rgb[0], 0.75F);
    EXPECT_NEAR(result.final_render->matched.bias, -1.0 / 3.0, 1e-6);
    EXPECT_NEAR(result.final_render->matched.relmse, 0.0625 / (0.5625 + 0.01), 1e-6);
    EXPECT_FLOAT_EQ(result.references[0].image.rgb[0], 0.5F) << "the matched one stays what it was";
    const CurvePoint& point = result.curves[1].points[0];  // Bounce's pictures are 0.6
    EXPECT_NEAR(point.bias, 0.2, 5e-4) << "pictures are written as halves";
    ASSERT_TRUE(point.final_errors);
    EXPECT_NEAR(point.final_errors->bias, -0.2, 5e-4);
    EXPECT_NEAR(point.final_errors->relmse, 0.0225 / (0.5625 + 0.01), 1e-4);
    const auto job = nlohmann::json::parse(blender_jobs().back());
    EXPECT_TRUE(job.at("bounces").is_null());
    const size_t before = blender_jobs().size();
    EXPECT_TRUE(evaluate(options_).final_render->references[0].cached);
    EXPECT_EQ(blender_jobs().size(), before) << "both references are kept, each under its own key";
    write_report(result, folder_ / "report");
    EXPECT_TRUE(std::filesystem::is_regular_file(folder_ / "report/frames/final.0024.exr"));
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
