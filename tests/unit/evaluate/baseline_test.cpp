// SPDX-License-Identifier: Apache-2.0
#include "evaluate/baseline.h"

#include <cmath>
#include <fstream>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "evaluate/report.h"
#include "temporary_folder.h"

namespace bounce {
namespace {

using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

CurvePoint point(const std::string& label, double relmse, double flip, double bias, double seconds = 0.1) {
    CurvePoint made = make_point(label, {{1, seconds, relmse, relmse, flip, 0.9, 30.0, bias, 0}});
    made.options = {"--vpls", label};
    return made;
}

Evaluation run(std::vector<CurvePoint> points) {
    Evaluation evaluation;
    evaluation.scene = "room.glb";
    evaluation.scene_sha256 = "abc";
    evaluation.width = 8;
    evaluation.height = 4;
    evaluation.frames = {1};
    evaluation.references = {{1, Image(8, 4), 1e-5, 124.0, false}};
    evaluation.curves = {{"ISM", false, std::move(points)}};
    return evaluation;
}

class BaselineTest : public testing::Test {
  protected:
    [[nodiscard]] std::filesystem::path path() const { return folder_ / "baseline.json"; }
    Baseline write_and_read(const nlohmann::ordered_json& json) {
        std::ofstream(path()) << json.dump();
        return read_baseline(path());
    }
    std::string refusal(const std::string& text) {
        std::ofstream(path()) << text;
        try {
            (void)read_baseline(path());
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::input_refused);
            return error.what();
        }
        return {};
    }
    TemporaryFolder folder_;
};

TEST_F(BaselineTest, TheSameRunHasNotBecomeWorse) {
    const Evaluation evaluation = run({point("64", 0.02, 0.1, -0.04), point("256", 0.01, 0.05, 0.0)});
    const auto report = compare_with_baseline(write_and_read(baseline_json(evaluation)), evaluation);
    EXPECT_EQ(report.compared, 2U);
    EXPECT_THAT(report.regressions, IsEmpty());
    EXPECT_THAT(report.missing, IsEmpty());
    EXPECT_THAT(report.added, IsEmpty());
}

TEST_F(BaselineTest, AResultsFileServesToo) {
    const Evaluation evaluation = run({point("64", 0.02, 0.1, -0.04)});
    const Baseline baseline = write_and_read(results_json(evaluation));
    EXPECT_EQ(baseline.tolerances.at("relmse").relative, default_tolerances().at("relmse").relative);
    EXPECT_THAT(compare_with_baseline(baseline, evaluation).regressions, IsEmpty());
}

TEST_F(BaselineTest, TimesAndAMachineAreNotInIt) {
    const std::string text = baseline_json(run({point("64", 0.02, 0.1, 0.0, 1234.5)})).dump();
    EXPECT_THAT(text, testing::Not(HasSubstr("1234.5")));
    EXPECT_THAT(text, testing::Not(HasSubstr("seconds")));
}

// Each limit by hand: old * (1 + relative) + absolute.
TEST_F(BaselineTest, EachErrorHasItsLimit) {
    auto json = baseline_json(run({point("64", 0.02, 0.1, -0.04)}));
    for (const char* name : {"relmse", "flip_ldr", "bias"}) {
        json["tolerances"][name] = {{"relative", 0.5}, {"absolute", 0.01}, {"reason", "by hand"}};
    }
    const Baseline baseline = write_and_read(json);
    const auto regressions = [&](double relmse, double flip, double bias) {
        return compare_with_baseline(baseline, run({point("64", relmse, flip, bias)})).regressions;
    };
    EXPECT_THAT(regressions(0.0399, 0.1599, 0.0699), IsEmpty());
    EXPECT_THAT(regressions(0.0401, 0.1, 0.0), ElementsAre(HasSubstr("ISM, 64: relmse is 0.0401, was 0.02")));
    EXPECT_THAT(regressions(0.02, 0.1601, 0.0), ElementsAre(HasSubstr("flip_ldr")));
    EXPECT_THAT(regressions(0.02, 0.1, 0.0701), ElementsAre(HasSubstr("bias")));
    EXPECT_THAT(regressions(0.02, 0.1, -0.0701), ElementsAre(HasSubstr("bias")));
    EXPECT_THAT(regressions(0.0, 0.0, 0.0), IsEmpty()) << "better is no regression";
    EXPECT_THAT(regressions(1.0, 1.0, 1.0), testing::SizeIs(3)) << "a line each";
}

TEST_F(BaselineTest, NotANumberIsAlwaysWorse) {
    const Baseline baseline = write_and_read(baseline_json(run({point("64", 0.02, 0.1, 0.0)})));
    EXPECT_THAT(compare_with_baseline(baseline, run({point("64", k_nan, 0.1, 0.0)})).regressions,
                ElementsAre(HasSubstr("relmse is nan")));
    Evaluation broken = run({point("64", 0.02, 0.1, 0.0)});
    broken.curves[0].points[0].frames[0].not_finite = 3;
    EXPECT_THAT(compare_with_baseline(baseline, broken).regressions,
                ElementsAre(HasSubstr("3 values are NaN")));
}

TEST_F(BaselineTest, NamesPointsThatAreInOneAlone) {
    const Baseline baseline =
        write_and_read(baseline_json(run({point("64", 0.02, 0.1, 0.0), point("256", 0.01, 0.1, 0.0)})));
    const auto report =
        compare_with_baseline(baseline, run({point("64", 0.02, 0.1, 0.0), point("1024", 9.0, 0.9, 0.0)}));
    EXPECT_THAT(report.missing, ElementsAre("ISM, 256"));
    EXPECT_THAT(report.added, ElementsAre("ISM, 1024"));
    EXPECT_THAT(report.regressions, IsEmpty());
    EXPECT_FALSE(report.passed()) << "a point is missing";
    EXPECT_TRUE(
        compare_with_baseline(baseline, run({point("64", 0.02, 0.1, 0.0), point("256", 0.01, 0.1, 0.0),
                                             point("1024", 9.0, 0.9, 0.0)}))
            .passed())
        << "a point more is no harm";
    EXPECT_THROW((void)compare_with_baseline(baseline, run({point("1024", 9.0, 0.9, 0.0)})), Error);
}

TEST_F(BaselineTest, OtherConditionsAreRefused) {
    const Baseline baseline = write_and_read(baseline_json(run({point("64", 0.02, 0.1, 0.0)})));
    const auto refused = [&](auto change) {
        Evaluation other = run({point("64", 0.02, 0.1, 0.0)});
        change(other);
        EXPECT_THROW((void)compare_with_baseline(baseline, other), Error);
    };
    refused([](Evaluation& other) { other.width = 16; });
    refused([](Evaluation& other) { other.height = 16; });
    refused([](Evaluation& other) { other.frames = {2}; });
    refused([](Evaluation& other) { other.bounces = 2; });
    refused([](Evaluation& other) { other.scene = "other.glb"; });
}

TEST_F(BaselineTest, RefusesWhatItCannotUse) {
    EXPECT_THROW((void)read_baseline(folder_ / "missing.json"), Error);
    EXPECT_THROW((void)read_baseline(folder_.path()), Error) << "a folder";
    EXPECT_THAT(refusal("{ half"), HasSubstr("not JSON"));
    EXPECT_THAT(refusal("{}"), testing::EndsWith("cannot be used: it has no \"scene\""));
    EXPECT_THAT(refusal("{\"schema\": \"bounce.baseline/2\"}"), HasSubstr("bounce.baseline/2"));
    const auto json = baseline_json(run({point("64", 0.02, 0.1, 0.0)}));
    auto changed = json;
    changed["curves"][0]["points"][0]["relmse"] = nullptr;
    EXPECT_THAT(refusal(changed.dump()), HasSubstr("relmse of ISM, 64 is not a number"));
    changed["curves"] = 7;
    EXPECT_THAT(refusal(changed.dump()), testing::EndsWith("cannot be used: curves is 7, not a list"));
    changed["frames"] = {"first"};
    EXPECT_THAT(refusal(changed.dump()), testing::EndsWith("frames is [\"first\"], not a list of numbers"));
    changed = json;
    changed["tolerances"]["relmse"]["reason"] = 1;
    EXPECT_THAT(refusal(changed.dump()), testing::EndsWith("reason is 1, not a text"));
    changed["tolerances"]["relmse"]["reason"] = "";
    EXPECT_THAT(refusal(changed.dump()), HasSubstr("a reason"));
    changed = json;
    changed["tolerances"]["relmse"]["relative"] = -0.1;
    EXPECT_THAT(refusal(changed.dump()), HasSubstr("two numbers"));
    changed = json;
    changed["tolerances"]["seconds"] = json["tolerances"]["relmse"];
    EXPECT_THAT(refusal(changed.dump()), HasSubstr("tolerance of seconds"));
}

}  // namespace
}  // namespace bounce
