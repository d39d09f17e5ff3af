// SPDX-License-Identifier: Apache-2.0
#include "cli/tuned_options.h"

#include <algorithm>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "evaluate/sweep_axes.h"
#include "evaluate/tuning.h"
#include "temporary_folder.h"

namespace bounce::cli {
namespace {

using bounce::test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;

class TunedOptionsTest : public testing::Test {
  protected:
    // A file with one set of settings for 33 ms.
    void write(const std::vector<std::string>& options) {
        Tuning tuning;
        tuning.scene = "room.blend";
        tuning.budgets = {{33, 0.03, 0.1, 0.2, 0.0, "VPLs", "64 VPLs", options}};
        std::ofstream(path()) << tuning_json(tuning).dump();
    }
    [[nodiscard]] std::string path() const { return (folder_ / "tuning.json").string(); }

    // As `bounce render` would take the words, with a budget and the file.
    [[nodiscard]] RenderOptions render(std::vector<std::string> words,
                                       const std::string& budget = "40") const {
        CLI::App app;
        RenderOptions typed;
        std::string output;
        app.add_option("-o,--output", output);
        typed.add_to(app);
        words.insert(words.end(), {"--budget-ms", budget, "--tuning", path()});
        std::reverse(words.begin(), words.end());
        app.parse(words);
        return with_tuning(app, typed);
    }
    [[nodiscard]] std::pair<ExitCode, std::string> refusal(const std::vector<std::string>& words,
                                                           const std::string& budget = "40") const {
        try {
            (void)render(words, budget);
        } catch (const Error& error) {
            return {error.code(), error.what()};
        }
        return {ExitCode::done, {}};
    }
    TemporaryFolder folder_;
};

TEST_F(TunedOptionsTest, TakesTheFilesSettings) {
    write({"--vpls", "64", "--ism-size", "32", "--bounces", "2"});
    const RenderOptions options = render({"-o", "a.exr", "--size", "8x4"});
    EXPECT_EQ(options.vpls, 64);
    EXPECT_EQ(options.ism_size, 32);
    EXPECT_EQ(options.bounces, 2);
    EXPECT_EQ(options.size, "8x4");
    EXPECT_EQ(options.interleave, std::nullopt);
}

TEST_F(TunedOptionsTest, WhatWasTypedCounts) {
    write({"--vpls", "64", "--near-field", "off"});
    const RenderOptions options =
        render({"--preset", "auto", "--vpls", "512", "--near-field", "on", "--glossy", "off"});
    EXPECT_EQ(options.vpls, 512);
    EXPECT_EQ(options.near_field, true);
    EXPECT_EQ(options.glossy, false);
}

TEST_F(TunedOptionsTest, APresetCanWin) {
    write({"--preset", "rsm2005"});
    EXPECT_EQ(render({"--preset", "auto"}).preset, "rsm2005");
}

TEST_F(TunedOptionsTest, AFileNeedsABudget) {
    const auto alone = [](const std::vector<std::string>& words) {
        CLI::App app;
        RenderOptions typed;
        typed.add_to(app);
        app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
        try {
            (void)with_tuning(app, typed);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::usage);
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(alone({"--budget-ms", "33"}), "") << "by preset auto's own model";
    EXPECT_THAT(alone({"--budget-ms", "33", "--preset", "ism2008"}), HasSubstr("--preset ism2008"));
    EXPECT_THAT(alone({"--tuning", "a.json"}), HasSubstr("--tuning needs --budget-ms"));
    EXPECT_EQ(alone({}), "");
}

TEST_F(TunedOptionsTest, RefusesWhatTheFileCannotGive) {
    EXPECT_EQ(refusal({}).first, ExitCode::input_refused) << "there is no file";
    write({"--vpls", "64"});
    EXPECT_EQ(refusal({}).first, ExitCode::done);
    EXPECT_THAT(refusal({}, "32").second, AllOf(HasSubstr("for 32 ms"), HasSubstr("least budget is 33 ms")));
    EXPECT_EQ(refusal({"--preset", "ism2008"}).first, ExitCode::usage);
    for (const std::vector<std::string>& options :
         std::vector<std::vector<std::string>>{{"--vpl-count", "64"},
                                               {"-x"},
                                               {"--size", "8x4"},
                                               {"--camera", "Side"},
                                               {"--show", "vpls"},
                                               {"--tuning", "other.json"},
                                               {"--help"},
                                               {"64"},
                                               {"--vpls"},
                                               {"--vpls", "many"},
                                               {"--vpls", "0"},
                                               {"--splat", "squares"},
                                               {"--technique", "direct", "--vpls", "64"}}) {
        write(options);
        const auto [code, sentence] = refusal({});
        EXPECT_EQ(code, ExitCode::input_refused) << options[0] << ": " << sentence;
        EXPECT_THAT(sentence, HasSubstr("tuning.json"));
        EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
    }
}

TEST_F(TunedOptionsTest, SaysWhichSettingsGoNotWithWhatWasTyped) {
    write({"--technique", "rsm"});
    const auto [code, sentence] = refusal({"--vpls", "64"});
    EXPECT_EQ(code, ExitCode::usage);
    EXPECT_THAT(sentence, AllOf(HasSubstr("--vpls"), HasSubstr("--technique rsm"), HasSubstr("33 ms")));
}

// What a sweep measures is what `bounce render` takes, and what a file can give.
TEST_F(TunedOptionsTest, EveryPointOfEveryAxisIsTaken) {
    for (const int bounces : {1, 4}) {
        for (const PreviewRun& run : sweep_runs({"all", "guard"}, bounces)) {
            write(run.render_arguments);
            EXPECT_EQ(refusal({}).second, "") << run.name << ", " << run.label;
        }
    }
}

}  // namespace
}  // namespace bounce::cli
