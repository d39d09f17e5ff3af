// SPDX-License-Identifier: Apache-2.0
#include "evaluate/report.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/process.h"
#include "temporary_folder.h"

namespace bounce {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;
using testing::Not;

Image constant(float value) {
    Image image(8, 4);
    std::fill(image.rgb.begin(), image.rgb.end(), value);
    return image;
}

CurvePoint point(const std::string& label, double seconds, double relmse) {
    return make_point(label, {{1, seconds, relmse, 2 * relmse, 0.1, 0.9, 30.0, -0.01, 0}});
}

Evaluation example() {
    Evaluation evaluation;
    evaluation.scene = "box </script> & co.blend";  // a name that would break out of a careless page
    evaluation.command = "bounce evaluate 'box </script> & co.blend' -o report";
    evaluation.date = "2024-01-02T03:04:05Z";
    evaluation.width = 8;
    evaluation.height = 4;
    evaluation.frames = {1};
    evaluation.machine = {"A processor", 2, "A system"};
    evaluation.gl_renderer = "A driver";
    evaluation.blender = "Blender 3.4.1";
    evaluation.cycles.version = "3.4.1";
    evaluation.references = {{1, constant(0.5F), 1e-5, 124.0, false}};
    evaluation.curves = {{"Cycles", true, {point("1 spp", 0.2, 0.3), point("64 spp", 8.0, 0.003)}},
                         {"RSM", false, {point("112", 0.1, 0.01), point("1024", 0.4, 0.002)}}};
    mark_pareto(evaluation.curves);
    evaluation.speedups = speedups_at_equal_error(evaluation.curves);
    for (const char* label : {"112", "1024"}) {
        evaluation.pictures.push_back({"RSM", label, 1, constant(0.4F)});
    }
    for (const char* label : {"1 spp", "64 spp"}) {
        evaluation.pictures.push_back({"Cycles", label, 1, constant(0.55F)});
    }
    return evaluation;
}

TEST(ResultsJson, KeepsTheContract) {
    const auto json = nlohmann::json::parse(results_json(example()).dump());
    EXPECT_TRUE(json.at("scene").is_string());
    const auto& reference = json.at("reference");
    for (const char* name : {"spp", "seconds", "noise_floor_relmse"}) {
        EXPECT_TRUE(reference.at(name).is_number()) << name;
    }
    EXPECT_EQ(reference.at("version"), "3.4.1");
    EXPECT_TRUE(reference.at("engine").is_string());
    ASSERT_EQ(json.at("curves").size(), 2U);
    for (const auto& curve : json["curves"]) {
        EXPECT_TRUE(curve.at("name").is_string());
        for (const auto& item : curve.at("points")) {
            EXPECT_TRUE(item.at("label").is_string());
            for (const char* name : {"seconds", "relmse", "flip_ldr", "bias"}) {
                EXPECT_TRUE(item.at(name).is_number()) << name;
            }
        }
    }
    ASSERT_EQ(json.at("speedup_at_equal_error").size(), 2U);
    for (const auto& item : json["speedup_at_equal_error"]) {
        EXPECT_EQ(item.at("curve"), "RSM");
        for (const char* name : {"relmse", "bounce_seconds", "cycles_seconds", "ratio"}) {
            EXPECT_TRUE(item.at(name).is_number()) << name;
        }
        EXPECT_NEAR(item["ratio"].get<double>(),
                    item["cycles_seconds"].get<double>() / item["bounce_seconds"].get<double>(), 1e-9);
    }
}

TEST(ResultsJson, NotANumberBecomesNull) {
    Evaluation evaluation = example();
    evaluation.curves[1].points[0].relmse = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(results_json(evaluation)["curves"][1]["points"][0]["relmse"].is_null());
}

// The rows of a table whose cells hold no commas, by the names in its head. Every row has as many cells as
// that.
std::vector<std::map<std::string, std::string>> rows_of(const std::string& csv) {
    const auto cells_of = [](const std::string& line) {
        std::vector<std::string> cells;
        std::istringstream in(line + ",");
        for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
        return cells;
    };
    std::istringstream in(csv);
    std::string line;
    std::getline(in, line);
    const std::vector<std::string> head = cells_of(line);
    std::vector<std::map<std::string, std::string>> rows;
    while (std::getline(in, line)) {
        const std::vector<std::string> cells = cells_of(line);
        EXPECT_EQ(cells.size(), head.size()) << line;
        auto& row = rows.emplace_back();
        for (size_t i = 0; i < std::min(cells.size(), head.size()); ++i) row[head[i]] = cells[i];
    }
    return rows;
}

TEST(ResultsCsv, HasARowAPointAndOneAFrame) {
    Evaluation evaluation = example();
    FrameError error{1, 0.1, 0.01, 0.02, 0.1, 0.9, 30.0, -0.01, 0.3, 0.4, {0.1, 0.2, -0.3}, 2.5, 7, 3, 0};
    evaluation.curves[1].points[0] = make_point("112", {error});
    const auto rows = rows_of(results_csv(evaluation));
    ASSERT_EQ(rows.size(), 4U * 2U);
    auto mean = rows[4];
    auto frame = rows[5];
    const std::map<std::string, std::string> both{
        {"curve", "\"RSM\""},       {"label", "\"112\""}, {"seconds", "0.1"}, {"relmse", "0.01"},
        {"relmse_exposed", "0.02"}, {"flip_ldr", "0.1"},  {"flip_hdr", ""},   {"ssim", "0.9"},
        {"psnr_db", "30"},          {"nrmse", "0.3"},     {"smape", "0.4"},   {"bias", "-0.01"},
        {"bias_r", "0.1"},          {"bias_g", "0.2"},    {"bias_b", "-0.3"}, {"seconds_least", ""}};
    for (const auto& [name, value] : both) {
        EXPECT_EQ(mean.at(name), value) << name;
        EXPECT_EQ(frame.at(name), value) << name;
    }
    EXPECT_EQ(mean.at("frame"), "mean");
    EXPECT_EQ(frame.at("frame"), "1");
    EXPECT_EQ(mean.at("ratio"), "30.4964");
    EXPECT_EQ(mean.at("cycles_time"), "interpolated");
    EXPECT_EQ(frame.at("cycles_time"), "");
    EXPECT_EQ(frame.at("max_abs") + " " + frame.at("max_x") + " " + frame.at("max_y"), "2.5 7 3");
    EXPECT_EQ(mean.at("max_x"), "");
}

TEST(Results, HaveTheFinalRender) {
    Evaluation evaluation = example();
    EXPECT_TRUE(results_json(evaluation).at("final_render").is_null());
    EXPECT_EQ(rows_of(results_csv(evaluation))[4].at("final_relmse"), "");
    evaluation.final_render = FinalRender{evaluation.references, {0.25, 0.5, 0.75, 20.0, -0.125}};
    evaluation.curves[1].points[0].final_errors = FinalErrors{0.5, 0.25, 0.875, 30.0, 0.0625};
    const auto json = results_json(evaluation);
    EXPECT_EQ(json["final_render"]["matched_reference"]["bias"], -0.125);
    EXPECT_EQ(json["final_render"]["frames"].size(), 1U);
    EXPECT_EQ(json["curves"][1]["points"][0]["final_render"]["flip_ldr"], 0.25);
    const auto rows = rows_of(results_csv(evaluation));
    EXPECT_EQ(rows[4].at("final_relmse"), "0.5");
    EXPECT_EQ(rows[4].at("final_bias"), "0.0625");
    EXPECT_EQ(rows[5].at("final_bias"), "") << "of the mean alone";
    EXPECT_THAT(results_table(evaluation),
                HasSubstr("the reference itself is off by relMSE 0.25, FLIP 0.5000, -12.50%"));
    evaluation.given_reference = "ref.####.exr";
    EXPECT_THAT(results_table(evaluation), HasSubstr("the reference itself is off by"))
        << "also against a given one";
}

TEST(ResultsCsv, WhatIsNoNumberIsEmpty) {
    Evaluation evaluation = example();
    evaluation.curves[1].points[0].relmse = std::numeric_limits<double>::quiet_NaN();
    evaluation.curves[1].points[0].psnr_db = std::numeric_limits<double>::infinity();
    const auto rows = rows_of(results_csv(evaluation));
    EXPECT_EQ(rows[4].at("relmse"), "");
    EXPECT_EQ(rows[4].at("psnr_db"), "");
}

// As an evaluation of frames 1 and 2 leaves it, with TID and HDR-FLIP and too short for a spectrum.
Evaluation sequence() {
    Evaluation evaluation = example();
    evaluation.frames = {1, 2};
    evaluation.sequence_step = 1;
    evaluation.motion = true;
    double step = 0.125;
    for (Curve& curve : evaluation.curves) {
        for (CurvePoint& item : curve.points) {
            SequenceMetrics metrics;
            metrics.frames.resize(2);
            metrics.mean_luminance = 0.5;
            metrics.flip_step_mean = metrics.flip_step_max = step;
            metrics.flip_step_max_frame = 2;
            metrics.flip_step_reference_mean = metrics.flip_step_reference_max = 0.0625;
            metrics.tid = 0.25;
            metrics.tid_relative = 0.5;
            metrics.tid_reference = 0.375;
            metrics.tid_coverage = 1.0;
            metrics.flicker_power = metrics.flicker_share = std::numeric_limits<double>::quiet_NaN();
            item.sequence = metrics;
            item.flip_hdr = item.frames[0].flip_hdr = 0.875;
            step += 0.0625;
        }
    }
    return evaluation;
}

TEST(ResultsCsv, HasTheSequencesFiguresInTheMeansRow) {
    const auto rows = rows_of(results_csv(sequence()));
    const std::map<std::string, std::string> figures{{"flip_step_mean", "0.25"},
                                                     {"flip_step_max", "0.25"},
                                                     {"flip_step_reference_mean", "0.0625"},
                                                     {"flip_step_reference_max", "0.0625"},
                                                     {"tid", "0.25"},
                                                     {"tid_relative", "0.5"},
                                                     {"tid_reference", "0.375"},
                                                     {"tid_coverage", "1"},
                                                     {"flicker_power", ""},
                                                     {"flicker_share", ""}};
    for (const auto& [name, value] : figures) {
        EXPECT_EQ(rows[4].at(name), value) << name;
        EXPECT_EQ(rows[5].at(name), "") << name;
    }
    EXPECT_EQ(rows[4].at("flip_hdr"), "0.875");
    EXPECT_EQ(rows[5].at("flip_hdr"), "0.875");
}

TEST(ResultsJson, HasTheSequenceOfEachPoint) {
    const auto json = results_json(sequence());
    EXPECT_EQ(json.at("sequence").at("step"), 1);
    EXPECT_EQ(json["sequence"].at("motion"), true);
    const auto& item = json["curves"][1]["points"][0];
    EXPECT_EQ(item.at("flip_hdr"), 0.875);
    EXPECT_EQ(item.at("frames")[0].at("flip_hdr"), 0.875);
    EXPECT_EQ(item.at("ssim"), 0.9);
    EXPECT_EQ(item.at("sequence").at("flip_step_mean"), 0.25);
    EXPECT_EQ(item["sequence"].at("flip_step_reference_mean"), 0.0625);
    EXPECT_EQ(item["sequence"].at("tid_reference"), 0.375);
    EXPECT_TRUE(item["sequence"].at("flicker_power").is_null());
    const auto single = results_json(example());
    EXPECT_TRUE(single.at("sequence").is_null());
    EXPECT_TRUE(single["curves"][0]["points"][0].at("sequence").is_null());
    EXPECT_TRUE(single["curves"][0]["points"][0].at("flip_hdr").is_null());
}

TEST(ResultsTable, ShowsTimeToEqualError) {
    const std::string table = results_table(example());
    EXPECT_THAT(table, HasSubstr("relMSE"));
    EXPECT_THAT(table, HasSubstr("noise floor 1e-05"));
    EXPECT_THAT(table, HasSubstr("(extrapolated)")) << "0.002 lies beyond Cycles' 64 spp";
}

TEST(ShownPoints, AreTheMostExactAndTheNearestInTime) {
    const auto shown = shown_points(example());
    ASSERT_EQ(shown.size(), 2U);
    EXPECT_EQ(shown[0], (std::pair<std::string, std::string>("RSM", "1024")));
    EXPECT_EQ(shown[1],
              (std::pair<std::string, std::string>("Cycles", "1 spp")));  // 0.2 s is nearest to 0.4 s
}

TEST(ResultsHtml, IsSelfContainedAndHoldsTheData) {
    const std::string page = results_html(example());
    EXPECT_THAT(page, HasSubstr("\"ratio\""));
    EXPECT_THAT(page, HasSubstr("data:image/png;base64,iVBOR"));
    EXPECT_THAT(page, HasSubstr("Chart.js v3"));
    EXPECT_THAT(page, HasSubstr("Permission is hereby granted"));
    EXPECT_THAT(page, Not(HasSubstr("src=\"http")));
    EXPECT_THAT(page, Not(HasSubstr("href=\"http")));
    EXPECT_THAT(page, Not(HasSubstr("/*RESULTS*/")));
    EXPECT_THAT(page, Not(HasSubstr("box </script>")));
}

// The page as a browser builds it: its text comes from its script.
TEST(ResultsHtml, OpensInABrowser) {
    const auto chromium = find_program("chromium");
    if (!chromium) {
        GTEST_SKIP() << "chromium is not installed here";
    }
    const TemporaryFolder folder;
    std::ofstream(folder / "index.html") << results_html(example());
    const ProcessResult result = run_process(
        {chromium->string(), "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic",
         "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
         "--user-data-dir=" + (folder / "profile").string(), "--virtual-time-budget=5000", "--dump-dom",
         "file://" + (folder / "index.html").string()});
    ASSERT_EQ(result.exit_code, 0) << result.output;
    EXPECT_THAT(result.output, Not(HasSubstr("Uncaught")));
    EXPECT_THAT(result.output, HasSubstr("<td>64 spp</td>"));
    EXPECT_THAT(result.output, HasSubstr("A processor, 2 threads, A system"));
    EXPECT_THAT(result.output, HasSubstr("<h1 id=\"title\">box &lt;/script&gt; &amp; co.blend"));
    EXPECT_THAT(result.output, HasSubstr("aria-pressed=\"true\">Frame 1</button>"));
}

}  // namespace
}  // namespace bounce
