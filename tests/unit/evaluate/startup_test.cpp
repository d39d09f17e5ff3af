// SPDX-License-Identifier: Apache-2.0
#include "evaluate/startup.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "environment.h"
#include "fake_programs.h"
#include "temporary_folder.h"

namespace bounce {
namespace {

using test::Environment;
using test::TemporaryFolder;
using testing::HasSubstr;
using testing::Not;

PreviewResult preview(double start, double load, double first) {
    PreviewResult result;
    result.startup_seconds = 99.0;
    result.start_seconds = start;
    result.load_seconds = load;
    result.first_frame_seconds = first;
    return result;
}

PeerResult peer(const std::string& name, double together, double first_render, double exported) {
    CachedRender render;
    render.startup_seconds = together;
    render.first_render_seconds = first_render;
    render.export_seconds = exported;
    return {name, "", {{name, "1", {{1, render, false}}}}, {}, {}};
}

Evaluation all_engines() {
    Evaluation evaluation;
    evaluation.cycles.version = "9.9.9";
    evaluation.cycles.startup_seconds = 2.5;
    evaluation.cycles.first_render_seconds = 0.75;
    evaluation.peers = {peer("Eevee", 6.0, 7.0, 0.0), peer("f3d", 4.0, 0.0, 0.25)};
    return evaluation;
}

TEST(StartUps, AreStatedApartOfEveryEngine) {
    const auto rows =
        startups_of(all_engines(), {preview(0.5, 0.2, 3.0), preview(0.1, 0.9, 1.0), preview(0.3, 0.4, 2.0)},
                    1.5, {.display = 3.0, .blender = 1.0, .f3d = 0.25});
    ASSERT_EQ(rows.size(), 4U);
    const auto expect = [&](size_t row, const char* engine, std::vector<double> seconds) {
        const StartUp& it = rows[row];
        EXPECT_EQ(it.engine, engine);
        EXPECT_EQ((std::vector<double>{it.export_seconds, it.display_seconds, it.start_seconds,
                                       it.load_seconds, it.first_render_seconds}),
                  seconds)
            << engine;
    };
    expect(0, "Bounce", {1.5, 0.0, 0.3, 0.4, 2.0});  // the median of each
    expect(1, "Cycles", {0.0, 0.0, 1.0, 1.5, 0.75});
    expect(2, "Eevee", {0.0, 3.0, 1.0, 2.0, 7.0});
    expect(3, "f3d", {0.25, 3.0, 0.25, 0.75, 0.0});
    EXPECT_THAT(rows[1].note, HasSubstr("timed by itself"));
    EXPECT_THAT(rows[3].note, HasSubstr("f3d does not tell apart"));
}

TEST(StartUps, F3dsFirstRenderIsApartWhereItsLoadWasTimed) {
    Evaluation evaluation = all_engines();
    evaluation.peers[1].points[0].frames[0].render.first_render_seconds = 3.5;  // of 4 s of start
    const auto rows = startups_of(evaluation, {}, 0.0, {.display = 3.0, .blender = 1.0, .f3d = 0.25});
    const StartUp& row = rows.back();
    EXPECT_EQ(row.display_seconds, 3.0);
    EXPECT_EQ(row.start_seconds, 0.25);
    EXPECT_EQ(row.load_seconds, 0.25);
    EXPECT_EQ(row.first_render_seconds, 0.5);
    EXPECT_THAT(row.note, Not(HasSubstr("tell apart")));
}

// A start that was timed on a busier machine than the run, or not at all, is not taken off.
TEST(StartUps, WhatDoesNotFitIsNotTakenOff) {
    for (const EngineStarts& starts :
         {EngineStarts{}, EngineStarts{.display = 9.0, .blender = 9.0, .f3d = 9.0}}) {
        const auto rows = startups_of(all_engines(), {}, 0.0, starts);
        ASSERT_EQ(rows.size(), 3U);
        EXPECT_EQ(rows[0].load_seconds, 2.5);
        EXPECT_EQ(rows[1].load_seconds, 6.0);
        EXPECT_EQ(rows[2].load_seconds, 4.0);
        for (const StartUp& row : rows) {
            EXPECT_EQ(row.start_seconds, 0.0);
            EXPECT_EQ(row.display_seconds, 0.0);
            EXPECT_THAT(row.note, Not(HasSubstr("timed by itself")));
            EXPECT_THAT(row.note, HasSubstr("tell apart"));
        }
    }
}

TEST(EngineStarts, AreOfThoseThatDrew) {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "bin");
    const auto script = [&](const std::string& name, const std::string& text) {
        return test::write_script(folder / "bin" / name,
                                  "#!/bin/sh\necho \"$@\" >> " + (folder / name).string() + "\n" + text);
    };
    const auto blender = script("blender", "sleep 0.06\n");
    script("f3d", "sleep 0.03\n");
    script("xvfb-run", "sleep 0.09\n");
    const Environment display("DISPLAY", "");
    const Environment programs("PATH", (folder / "bin").string() + ":/usr/bin:/bin");
    const EngineStarts none = measure_engine_starts(blender, {});
    EXPECT_EQ(none.display + none.blender + none.f3d, 0.0);
    for (const char* name : {"blender", "f3d", "xvfb-run"}) {
        EXPECT_FALSE(std::filesystem::exists(folder / name)) << name;
    }
    EngineStarts all = measure_engine_starts(blender, all_engines());
    EXPECT_GT(all.display, 0.09);
    EXPECT_GT(all.blender, 0.06);
    EXPECT_GT(all.f3d, 0.03);
    const Environment shown("DISPLAY", ":9");
    script("blender", "exit 1\n");
    all = measure_engine_starts(blender, all_engines());
    EXPECT_EQ(all.display, 0.0) << "there is one";
    EXPECT_EQ(all.blender, 0.0) << "it failed";
    EXPECT_GT(all.f3d, 0.03);
}

}  // namespace
}  // namespace bounce
