// SPDX-License-Identifier: Apache-2.0
//
// bounce compare with sequences, from the words of the command line to exit code, output and files; in this
// process, because starting the program takes longer than what it does here.
#include <algorithm>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/cli.h"
#include "image/image_io.h"
#include "temporary_folder.h"

namespace bounce::cli {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;
using testing::Not;

struct Result {
    int exit_code = 0;
    std::string output;  // stdout, then stderr
};

class CompareSequence : public testing::Test {
  protected:
    // test: 0.5 +- 0.05 from frame to frame; ref: 0.5; motion: none, 5 m away.
    void SetUp() override {
        for (int frame = 1; frame <= 8; ++frame) {
            write("test", frame, frame % 2 == 0 ? 0.55F : 0.45F);
            write("ref", frame, 0.5F);
            if (frame > 1) {
                write("motion", frame, 0.0F, 16, 5.0F);
            }
        }
    }

    // blue: of its own where it is not negative.
    void write(const std::string& name, int frame, float value, int width = 16, float blue = -1.0F) {
        Image image(width, 12);
        for (size_t i = 0; i < image.rgb.size(); ++i) {
            image.rgb[i] = i % 3 == 2 && blue >= 0.0F ? blue : value;
        }
        write_image(path(name, frame), image);
    }

    std::filesystem::path path(const std::string& name, int frame) {
        return folder_ / fmt::format("{}.{:04}.exr", name, frame);
    }
    void remove(const std::string& name, int frame) { std::filesystem::remove(path(name, frame)); }

    // Arguments with a dot and without '=' are files of the test's folder.
    Result compare(std::vector<std::string> arguments) {
        for (std::string& argument : arguments) {
            if (argument.find('.') != std::string::npos && argument.find('=') == std::string::npos) {
                argument = (folder_ / argument).string();
            }
        }
        arguments.insert(arguments.begin(), {"bounce", "compare"});
        std::vector<char*> words;
        for (std::string& argument : arguments) {
            words.push_back(argument.data());
        }
        testing::internal::CaptureStdout();
        testing::internal::CaptureStderr();
        const int code = run(static_cast<int>(words.size()), words.data());
        std::string output = testing::internal::GetCapturedStdout();
        return {code, output + testing::internal::GetCapturedStderr()};
    }

    nlohmann::json read_json() {
        std::ifstream in(folder_ / "out.json");
        return nlohmann::json::parse(in);
    }

    void expect_refused(const std::vector<std::string>& arguments, int code, const std::string& why) {
        const Result result = compare(arguments);
        EXPECT_EQ(result.exit_code, code) << result.output;
        EXPECT_THAT(result.output, HasSubstr(why));
        const auto lines = std::count(result.output.begin(), result.output.end(), '\n');
        EXPECT_EQ(lines, 1) << "one sentence: " << result.output;
    }

    TemporaryFolder folder_;
};

TEST_F(CompareSequence, PrintsFramesAndTheWholeAndWritesJson) {
    const Result result =
        compare({"test.####.exr", "ref.####.exr", "--motion", "motion.####.exr", "--json", "out.json"});
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_THAT(result.output, HasSubstr("flicker_power"));
    EXPECT_THAT(result.output, HasSubstr("compare 8/8"));
    const auto json = read_json();
    ASSERT_EQ(json["frames"].size(), 8U);
    EXPECT_EQ(json["frames"][2]["frame"], 3);
    // 0.45 and 0.55 as halves are 0.4500 and 0.5498.
    EXPECT_NEAR(json["frames"][2]["bias"].get<double>(), -0.1, 1e-3);
    EXPECT_TRUE(json["frames"][0]["flip_step"].is_null());
    EXPECT_TRUE(json["frames"][0]["flip_hdr"].is_null()) << "not asked for";
    EXPECT_NEAR(json["mean"]["bias"].get<double>(), 0.0, 1e-3);
    const auto& whole = json["sequence"];
    EXPECT_NEAR(whole["flicker_power"].get<double>(), 0.01, 1e-4);
    EXPECT_NEAR(whole["tid"].get<double>(), 0.1, 1e-3);
    EXPECT_EQ(whole["tid_reference"], 0.0);
    EXPECT_GT(whole["flip_step_max"].get<double>(), 0.01);
}

TEST_F(CompareSequence, FramesChooseAPart) {
    EXPECT_EQ(compare({"test.####.exr", "ref.####.exr", "--frames", "2-8x2", "--json", "out.json"}).exit_code,
              0);
    const auto json = read_json();
    ASSERT_EQ(json["frames"].size(), 4U);
    EXPECT_EQ(json["frames"][3]["frame"], 8);
    EXPECT_EQ(json["sequence"]["flip_step_max"], 0.0) << "every second frame is the same picture";
    EXPECT_TRUE(json["sequence"]["flicker_power"].is_null()) << "four frames are too few";
}

TEST_F(CompareSequence, NeedsNoReference) {
    const Result result = compare({"test.####.exr", "--json", "out.json"});
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_NEAR(read_json()["sequence"]["flicker_power"].get<double>(), 0.01, 1e-4);
    EXPECT_TRUE(read_json()["sequence"]["tid"].is_null());
}

TEST_F(CompareSequence, HdrFlipIsThereWhereItIsAskedFor) {
    EXPECT_EQ(
        compare({"test.####.exr", "ref.####.exr", "--frames", "1-2", "--hdr-flip", "--json", "out.json"})
            .exit_code,
        0);
    EXPECT_TRUE(read_json()["frames"][0]["flip_hdr"].is_number());
    EXPECT_EQ(
        compare({"test.####.exr", "ref.####.exr", "--frames", "1-2", "--fail-above", "flip_hdr=1"}).exit_code,
        0);
}

TEST_F(CompareSequence, ThresholdsDecideTheExitCode) {
    const std::vector<std::string> base{"test.####.exr", "ref.####.exr", "--motion", "motion.####.exr"};
    const auto with = [&](std::vector<std::string> limits) {
        std::vector<std::string> arguments = base;
        for (const std::string& limit : limits) {
            arguments.insert(arguments.end(), {"--fail-above", limit});
        }
        return compare(arguments);
    };
    EXPECT_EQ(with({"tid=0.2", "flicker_power=0.02", "flip_step_max=0.5", "bias=0.2"}).exit_code, 0);
    for (const char* limit : {"tid=0.05", "tid_relative=0.1", "flicker_power=0.005", "flicker_share=0.5",
                              "flip_step_mean=0.001", "flip_step_max=0.001"}) {
        EXPECT_EQ(with({limit}).exit_code, 5) << limit;
    }
    // A metric of images counts in its worst frame.
    const Result bias = with({"bias=0.05"});
    EXPECT_EQ(bias.exit_code, 5);
    EXPECT_THAT(bias.output, HasSubstr("frame "));
    EXPECT_THAT(bias.output, HasSubstr("bias is "));
}

TEST_F(CompareSequence, NotANumberFailsAnyThreshold) {
    write("test", 4, std::numeric_limits<float>::quiet_NaN());
    for (const char* limit : {"relmse=1e9", "flip_step_max=1e9", "flicker_power=1e9", "nan=1e9"}) {
        const Result result = compare({"test.####.exr", "ref.####.exr", "--fail-above", limit});
        EXPECT_EQ(result.exit_code, 5) << limit;
        EXPECT_THAT(result.output, HasSubstr("576 values are NaN"));
    }
    EXPECT_EQ(compare({"test.####.exr", "ref.####.exr"}).exit_code, 0)
        << "without a threshold it only reports";
}

TEST_F(CompareSequence, WritesPicturesOfEachFrame) {
    EXPECT_EQ(compare({"test.####.exr", "ref.####.exr", "--heatmap", "heat.##.png"}).exit_code, 0);
    EXPECT_TRUE(std::filesystem::exists(folder_ / "heat.08.png"));
    expect_refused({"test.####.exr", "ref.####.exr", "--heatmap", "heat.png"}, 2, "--heatmap");
}

TEST_F(CompareSequence, RefusesMissingFrames) {
    remove("ref", 5);
    expect_refused({"test.####.exr", "ref.####.exr"}, 3, "frame 5 is missing in");
    expect_refused({"test.####.exr", "ref.####.exr", "--frames", "4-6"}, 3,
                   "frame 5 is missing: there is no file");
    remove("test", 5);
    expect_refused({"test.####.exr", "ref.####.exr"}, 3, "has frames 4 and 6 but not those between");
    expect_refused({"test.####.exr", "--frames", "1-9x4"}, 3, "frame 5 is missing");
    expect_refused({"nothing.####.exr", "ref.####.exr"}, 3, "no file matches");
    remove("motion", 3);
    expect_refused({"test.####.exr", "ref.####.exr", "--frames", "1-4", "--motion", "motion.####.exr"}, 3,
                   "motion.0003.exr");
}

TEST_F(CompareSequence, RefusesSequencesWithoutACommonFrame) {
    for (int frame = 1; frame <= 8; ++frame) {
        std::filesystem::rename(path("ref", frame), path("ref", frame + 20));
    }
    expect_refused({"test.####.exr", "ref.####.exr"}, 3, "have no frame in common");
}

TEST_F(CompareSequence, RefusesDifferentSizes) {
    write("ref", 3, 0.5F, 17);
    const Result reference = compare({"test.####.exr", "ref.####.exr"});
    EXPECT_EQ(reference.exit_code, 3);
    EXPECT_THAT(reference.output,
                HasSubstr("reference of frame 3 is 17x12 but the sequence began with 16x12"));
    EXPECT_THAT(reference.output, Not(HasSubstr("flicker_power")));
    write("motion", 2, 0.0F, 17, 5.0F);
    EXPECT_THAT(compare({"test.####.exr", "--motion", "motion.####.exr"}).output,
                HasSubstr("motion of frame 2 is 17x12"));
}

TEST_F(CompareSequence, RefusesWhatMakesNoSequence) {
    expect_refused({"test.####.exr", "ref.0001.exr"}, 2, "is one file but the image is a sequence");
    expect_refused({"test.0001.exr", "ref.####.exr"}, 2, "is for sequences");
    expect_refused({"test.0001.exr", "ref.0001.exr", "--frames", "1-2"}, 2, "--frames");
    expect_refused({"test.0001.exr", "ref.0001.exr", "--motion", "motion.####.exr"}, 2, "--motion");
    expect_refused({"test.0001.exr"}, 2, "give a reference");
    expect_refused({"test.####.exr", "ref.####.exr", "--frames", "3"}, 2, "one frame");
    expect_refused({"test.####.exr", "ref.####.exr", "--frames", "1,2,4"}, 2, "one step");
    expect_refused({"test.####.exr", "ref.####.exr", "--frames", "2,1"}, 2, "one step");
    expect_refused({"test.####.exr", "ref.####.exr", "--frames", "2-8x2", "--motion", "motion.####.exr"}, 2,
                   "without a step");
}

TEST_F(CompareSequence, RefusesThresholdsThatNothingCanTell) {
    expect_refused({"test.####.exr", "ref.####.exr", "--fail-above", "tid=1"}, 2, "needs --motion");
    expect_refused({"test.####.exr", "ref.####.exr", "--frames", "1-4", "--fail-above", "flicker_power=1"}, 2,
                   "needs 8 frames");
    expect_refused({"test.####.exr", "--fail-above", "relmse=1"}, 2, "needs a reference");
    expect_refused({"test.0001.exr", "ref.0001.exr", "--fail-above", "tid=1"}, 2, "is of sequences");
    expect_refused({"test.####.exr", "--fail-above", "nonsense=1"}, 2, "flicker_power");
}

}  // namespace
}  // namespace bounce::cli
