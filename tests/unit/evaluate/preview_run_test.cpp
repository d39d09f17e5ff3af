// SPDX-License-Identifier: Apache-2.0
#include "evaluate/preview_run.h"

#include <algorithm>
#include <iterator>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "fake_programs.h"
#include "temporary_folder.h"

namespace bounce {
namespace {

using test::TemporaryFolder;
using testing::EndsWith;
using testing::HasSubstr;

const PreviewRun k_run{"RSM", "112 samples", {"--technique", "rsm", "--rsm-samples", "112"}};

// Names and labels of the runs, which tell the points of a report apart.
std::vector<std::pair<std::string, std::string>> names_of(const std::vector<PreviewRun>& runs) {
    std::vector<std::pair<std::string, std::string>> names;
    for (const PreviewRun& run : runs) {
        names.emplace_back(run.name, run.label);
    }
    return names;
}

bool has(const PreviewRun& run, const std::string& option, const std::string& value) {
    const auto& all = run.render_arguments;
    const auto found = std::find(all.begin(), all.end(), option);
    return found != all.end() && found + 1 != all.end() && *(found + 1) == value;
}

TEST(PreviewRuns, AreDirectRsmAndLightsWithAndWithoutMaps) {
    const auto runs = default_preview_runs(1);
    EXPECT_EQ(runs[0].render_arguments, (std::vector<std::string>{"--technique", "direct"}));
    const auto names = names_of(runs);
    EXPECT_EQ(std::set(names.begin(), names.end()).size(), names.size())
        << "two points could not be told apart";
    for (const char* vpls : {"64 VPLs", "128 VPLs", "256 VPLs", "512 VPLs", "1024 VPLs"}) {
        EXPECT_THAT(names, testing::Contains(std::pair<std::string, std::string>("ISM", vpls)));
    }
    for (const PreviewRun& run : runs) {
        EXPECT_FALSE(has(run, "--bounces", "1")) << "the default";
        EXPECT_EQ(has(run, "--visibility", "none"), run.name == "VPLs, not occluded") << run.name;
    }
}

TEST(PreviewRuns, FollowTheReferencesBounces) {
    const auto two = default_preview_runs(2);
    const auto names = names_of(two);
    EXPECT_EQ(std::set(names.begin(), names.end()).size(), names.size());
    EXPECT_THAT(names, testing::Contains(std::pair<std::string, std::string>("ISM, 2 bounces", "256 VPLs")));
    EXPECT_THAT(names, testing::Contains(std::pair<std::string, std::string>("ISM, one bounce", "256 VPLs")));
    EXPECT_TRUE(has(two.back(), "--bounces", "2"));
    EXPECT_TRUE(has(default_preview_runs(9).back(), "--bounces", "4")) << "the most that bounce render draws";
    EXPECT_EQ(default_preview_runs(0).size(), 1U) << "direct light is all that such a reference has";
}

TEST(RunPreview, PassesArgumentsAndReadsStats) {
    const TemporaryFolder folder;
    test::write_constant(folder / "picture.exr", 0.5F, 4, 2);
    const auto bounce = test::fake_bounce(folder.path());
    const PreviewResult result =
        run_preview(bounce, "a scene.glb", k_run, {1, 24}, 320, 180, 3, folder / "out");
    ASSERT_EQ(result.frames.size(), 2U);
    EXPECT_EQ(result.frames[1].frame, 24);
    EXPECT_DOUBLE_EQ(result.frames[1].seconds, 0.020);
    EXPECT_EQ(read_image(result.frames[1].image).width, 4);
    EXPECT_EQ(result.gl_renderer, "r");
    EXPECT_GE(result.startup_seconds, 0.0);
    EXPECT_GT(result.start_seconds, 0.040) << "the process's own beside the context";
    EXPECT_DOUBLE_EQ(result.load_seconds, 0.250);
    EXPECT_DOUBLE_EQ(result.first_frame_seconds, 0.070);
    std::ifstream in(folder / "bounce_calls");
    const std::string call{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    EXPECT_THAT(call, HasSubstr("render a scene.glb -o"));
    EXPECT_THAT(call, HasSubstr("--frames 1,24 --size 320x180 --repeat 3"));
    EXPECT_THAT(call, HasSubstr("--technique rsm --rsm-samples 112"));
}

std::pair<ExitCode, std::string> failure_of(const std::string& script) {
    const TemporaryFolder folder;
    const auto bounce = test::write_script(folder / "bounce", script);
    try {
        (void)run_preview(bounce, "scene.glb", k_run, {1}, 4, 2, 1, folder / "out");
    } catch (const Error& error) {
        return {error.code(), error.what()};
    }
    return {ExitCode::done, ""};
}

TEST(RunPreview, KeepsTheCodesThatTheUserCanMend) {
    const auto no_gl = failure_of("#!/bin/sh\necho 'error: no OpenGL 4.5 here' >&2\nexit 4\n");
    EXPECT_EQ(no_gl.first, ExitCode::no_opengl);
    EXPECT_THAT(no_gl.second, HasSubstr("RSM, 112 samples"));
    EXPECT_THAT(no_gl.second, EndsWith("no OpenGL 4.5 here"));
    EXPECT_EQ(failure_of("#!/bin/sh\nexit 3\n").first, ExitCode::input_refused);
    EXPECT_EQ(failure_of("#!/bin/sh\nexit 2\n").first, ExitCode::failed)
        << "our own arguments, not the user's";
    EXPECT_EQ(failure_of("#!/bin/sh\nkill -9 $$\n").first, ExitCode::failed);
}

TEST(RunPreview, RefusesStatsThatDoNotFit) {
    const std::string prefix =
        "#!/bin/sh\nfor word; do [ \"$last\" = --stats ] && stats=$word; last=$word; done\n";
    EXPECT_THAT(failure_of(prefix + "true\n").second,
                EndsWith("stats.json cannot be used: it breaks off at line 1, column 1"));
    EXPECT_THAT(failure_of(prefix + "echo '{\"frames\": 3' > \"$stats\"\n").second,
                EndsWith("stats.json cannot be used: it breaks off at line 2, column 1"));
    EXPECT_THAT(failure_of(prefix + "echo '{\"frames\": [{}]}' > \"$stats\"\n").second,
                EndsWith("stats.json cannot be used: it has no \"frame\""));
    EXPECT_THAT(
        failure_of(prefix +
                   "echo '{\"frames\": [{\"frame\": 1, \"wall_ms\": 1}], \"startup\": {\"load_ms\": -1}}' "
                   "> \"$stats\"\n")
            .second,
        EndsWith("stats.json cannot be used: load_ms is -1, not a number of at least 0"));
    EXPECT_THAT(
        failure_of(prefix + "echo '{\"frames\": [{\"frame\": 7, \"wall_ms\": 1}]}' > \"$stats\"\n").second,
        HasSubstr("frames 7, not 1"));
}

}  // namespace
}  // namespace bounce
