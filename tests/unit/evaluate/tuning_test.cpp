// SPDX-License-Identifier: Apache-2.0
#include "evaluate/tuning.h"

#include <cmath>
#include <fstream>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "temporary_folder.h"

namespace bounce {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

CurvePoint point(const std::string& label, double seconds, double relmse) {
    CurvePoint made = make_point(label, {{1, seconds, relmse, relmse, 0.1, 0.9, 30.0, -0.02, 0}});
    made.options = {"--vpls", label};
    return made;
}

std::vector<std::string> labels(const std::vector<TunedSettings>& winners) {
    std::vector<std::string> all;
    for (const TunedSettings& winner : winners) {
        all.push_back(winner.label);
    }
    return all;
}

TEST(BudgetWinners, AreTheMostExactThatFit) {
    const std::vector<Curve> curves{{"A", false, {point("64", 0.010, 0.5), point("256", 0.030, 0.2)}},
                                    {"B", false, {point("x", 0.033, 0.1), point("slow", 0.900, 0.3)}}};
    const auto winners = budget_winners(curves, {5, 16, 33, 1000});
    ASSERT_EQ(labels(winners), (std::vector<std::string>{"64", "x", "x"})) << "nothing fits into 5 ms";
    EXPECT_EQ(winners[1].budget_ms, 33) << "a point of just the budget fits";
    EXPECT_EQ(winners[1].curve, "B");
    EXPECT_EQ(winners[1].options, (std::vector<std::string>{"--vpls", "x"}));
    EXPECT_EQ(winners[1].bias, -0.02);
}

TEST(BudgetWinners, OfEqualErrorsTheFastest) {
    EXPECT_EQ(labels(budget_winners({{"A", false, {point("a", 0.02, 0.1), point("b", 0.01, 0.1)}}}, {33})),
              (std::vector<std::string>{"b"}));
}

TEST(BudgetWinners, NotANumberAndOtherEnginesNeverWin) {
    std::vector<Curve> curves{{"Cycles", true, {point("1 spp", 0.001, 1e-9)}},
                              {"A", false, {point("a", k_nan, 0.1), point("b", 0.01, k_nan)}}};
    curves[0].points[0].options.clear();
    EXPECT_TRUE(budget_winners(curves, {33}).empty());
}

TEST(BudgetWinners, SecondsForAFrameAreNoSettings) {
    CurvePoint converged = point("1 s", 0.01, 1e-9);
    converged.options = {"--converge", "--time-limit", "1"};
    EXPECT_EQ(labels(budget_winners({{"A", false, {point("a", 0.02, 0.1), converged}}}, {33})),
              (std::vector<std::string>{"a"}));
}

Tuning example() {
    return {"cornell.blend",
            640,
            360,
            2,
            "A processor",
            2,
            "A driver",
            {{33, 0.03, 0.1, 0.2, -0.02, "VPLs", "64 VPLs", {"--vpls", "64"}},
             {250, 0.2, 0.01, 0.1, 0.0, "Presets", "auto", {"--preset", "auto", "--bounces", "2"}}}};
}

std::string refusal(const std::filesystem::path& path) {
    try {
        (void)read_tuning(path);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_refused);
        return error.what();
    }
    return {};
}

TEST(TuningFile, IsReadAsItWasWritten) {
    const TemporaryFolder folder;
    std::ofstream(folder / "tuning.json") << tuning_json(example()).dump();
    const Tuning read = read_tuning(folder / "tuning.json");
    EXPECT_EQ(tuning_json(read), tuning_json(example()));
    EXPECT_EQ(read.budgets[1].options, example().budgets[1].options);
}

TEST(TuningFile, LargestBudgetThatIsAtMostTheTime) {
    const Tuning tuning = example();
    EXPECT_EQ(settings_within(tuning, 32.9), nullptr);
    EXPECT_EQ(settings_within(tuning, 33)->label, "64 VPLs");
    EXPECT_EQ(settings_within(tuning, 249)->label, "64 VPLs");
    EXPECT_EQ(settings_within(tuning, 1e9)->label, "auto");
}

TEST(TuningFile, RefusesWhatItCannotUse) {
    const TemporaryFolder folder;
    const auto path = folder / "tuning.json";
    EXPECT_THAT(refusal(path), HasSubstr("cannot read"));
    const auto write = [&](const std::string& text) { std::ofstream(path) << text; };
    write("{ half");
    EXPECT_THAT(refusal(path), HasSubstr("is not JSON"));
    write("{}");
    EXPECT_THAT(refusal(path), HasSubstr("schema null"));
    write("{\"schema\": \"bounce.tuning/2\"}");
    EXPECT_THAT(refusal(path), HasSubstr("bounce.tuning/2"));
    write("{\"schema\": \"bounce.tuning/1\", \"scene\": \"a\"}");
    EXPECT_THAT(refusal(path), HasSubstr("it has no \"width\""));
    auto json = tuning_json(example());
    json["budgets"][0]["options"] = "--vpls 64";
    write(json.dump());
    EXPECT_THAT(refusal(path),
                testing::EndsWith("tuning.json cannot be used: options is \"--vpls 64\", not a "
                                  "list of texts"));
    json = tuning_json(example());
    json["budgets"][0]["relmse"] = nullptr;
    write(json.dump());
    EXPECT_THAT(refusal(path), testing::EndsWith("cannot be used: relmse is null, not a number"));
    json["budgets"] = 3;
    write(json.dump());
    EXPECT_THAT(refusal(path), testing::EndsWith("cannot be used: budgets is 3, not a list"));
    json["machine"] = "mine";
    write(json.dump());
    EXPECT_THAT(refusal(path),
                testing::EndsWith("cannot be used: a text stands where an object or a list belongs"));
    json.erase("machine");
    write(json.dump());
    EXPECT_THAT(refusal(path), testing::EndsWith("cannot be used: it has no \"machine\""));
}

}  // namespace
}  // namespace bounce
