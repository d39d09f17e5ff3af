// SPDX-License-Identifier: Apache-2.0
#include "evaluate/sweep_axes.h"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"

namespace bounce {
namespace {

using testing::Contains;
using testing::HasSubstr;

std::set<std::string> titles(const std::vector<PreviewRun>& runs) {
    std::set<std::string> names;
    for (const PreviewRun& run : runs) {
        names.insert(run.name);
    }
    return names;
}

std::string refusal(const std::vector<std::string>& names, int bounces) {
    try {
        (void)sweep_runs(names, bounces);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::usage);
        return error.what();
    }
    return {};
}

TEST(SweepRuns, PointsOfAllAxesCanBeToldApart) {
    std::set<std::pair<std::string, std::string>> names;
    const auto runs = sweep_runs({"all", "guard"}, 4);
    for (const PreviewRun& run : runs) {
        names.emplace(run.name, run.label);
        EXPECT_FALSE(run.render_arguments.empty()) << run.name << ", " << run.label;
        EXPECT_NE(run.name, "Cycles") << "the name of the reference's ladder";
    }
    EXPECT_EQ(names.size(), runs.size());
}

TEST(SweepRuns, AnAxisIsOneCurveInOneBlock) {
    const auto runs = sweep_runs({"vpls", "ism-size", "vpls"}, 1);
    ASSERT_EQ(titles(runs), (std::set<std::string>{"VPLs", "Map size"}));
    std::vector<std::string> order;
    for (const PreviewRun& run : runs) {
        if (order.empty() || order.back() != run.name) {
            order.push_back(run.name);
        }
    }
    EXPECT_EQ(order, (std::vector<std::string>{"VPLs", "Map size"}));
}

TEST(SweepRuns, AllIsEveryAxisButTheGuardAndConvergence) {
    size_t axes = 0;
    for (const SweepAxis& axis : sweep_axes()) {
        axes += axis.part_of_all ? 1U : 0U;
    }
    EXPECT_EQ(titles(sweep_runs({"all"}, 2)).size(), axes);
    EXPECT_EQ(axes + 2, sweep_axes().size());
    EXPECT_EQ(titles(sweep_runs({"all"}, 1)).count("Bounces"), 0U) << "one point is no axis";
}

TEST(SweepRuns, BouncesFollowTheReferenceWhereTheSettingsHaveThem) {
    for (const PreviewRun& run : sweep_runs({"presets"}, 3)) {
        const bool further =
            std::count(run.render_arguments.begin(), run.render_arguments.end(), "--bounces") == 1;
        EXPECT_EQ(further, run.label != "rsm2005") << run.label;
        EXPECT_EQ(further, run.render_arguments.back() == "3") << run.label;
    }
    EXPECT_EQ(sweep_runs({"vpls"}, 9).front().render_arguments.back(), "4") << "the most that is drawn";
    for (const PreviewRun& run : sweep_runs({"vpls"}, 1)) {
        EXPECT_THAT(run.render_arguments, testing::Not(Contains("--bounces")));
    }
}

TEST(SweepRuns, TheAxisBouncesEndsAtTheReferences) {
    std::vector<std::string> labels;
    for (const PreviewRun& run : sweep_runs({"bounces"}, 3)) {
        labels.push_back(run.label);
    }
    EXPECT_EQ(labels, (std::vector<std::string>{"1 bounce", "2 bounces", "3 bounces"}));
}

TEST(SweepRuns, RefusesWhatIsNoSweep) {
    EXPECT_THAT(refusal({"vpls", "colour"}, 1), HasSubstr("--sweep colour"));
    EXPECT_THAT(refusal({"colour"}, 1), HasSubstr("ism-size"));
    EXPECT_THAT(refusal({"vpls"}, 0), HasSubstr("--bounces 1"));
    EXPECT_THAT(refusal({"bounces"}, 1), HasSubstr("--bounces 2"));
}

}  // namespace
}  // namespace bounce
