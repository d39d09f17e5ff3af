// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/process.h"
#include "image/image_io.h"
#include "temporary_folder.h"

namespace bounce {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

class CompareCommand : public testing::Test {
  protected:
    void SetUp() override {
        write(0.5F, "a.exr");
        write(0.6F, "b.exr");
    }

    void write(float value, const std::string& name, int width = 16) {
        Image image(width, 12);
        std::fill(image.rgb.begin(), image.rgb.end(), value);
        write_image(folder_ / name, image);
    }

    // Names without a slash before them are files of the test's folder.
    ProcessResult compare(std::vector<std::string> arguments) {
        for (std::string& argument : arguments) {
            if (argument.find('.') != std::string::npos && argument.find('=') == std::string::npos) {
                argument = (folder_ / argument).string();
            }
        }
        arguments.insert(arguments.begin(), {BOUNCE_BINARY_DIR "/bounce", "compare"});
        return run_process(arguments);
    }

    TemporaryFolder folder_;
};

TEST_F(CompareCommand, PrintsATableAndWritesJson) {
    const ProcessResult result = compare({"b.exr", "a.exr", "--json", "out.json"});
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_THAT(result.output, HasSubstr("relmse"));
    std::ifstream in(folder_ / "out.json");
    const auto json = nlohmann::json::parse(in);
    EXPECT_NEAR(json["relmse"].get<double>(), 0.01 / 0.26, 1e-4);
    EXPECT_NEAR(json["bias"].get<double>(), 0.2, 1e-3);
    EXPECT_EQ(json["width"], 16);
    EXPECT_EQ(json["height"], 12);
}

TEST_F(CompareCommand, WritesPictures) {
    EXPECT_EQ(compare({"b.exr", "a.exr", "--heatmap", "heat.png", "--difference", "diff.png"}).exit_code, 0);
    // sRGB of 0.6 and 0.5 (as halves): 0.797738 - 0.735357, four times.
    EXPECT_NEAR(read_image(folder_ / "diff.png").rgb[0], 0.2495F, 0.004F);
    EXPECT_EQ(read_image(folder_ / "heat.png").width, 16);
}

TEST_F(CompareCommand, ThresholdsDecideTheExitCode) {
    EXPECT_EQ(compare({"b.exr", "a.exr", "--fail-above", "relmse=0.1", "--fail-above", "bias=0.3"}).exit_code,
              0);
    const ProcessResult above =
        compare({"b.exr", "a.exr", "--fail-above", "relmse=0.1", "--fail-above", "bias=0.1"});
    EXPECT_EQ(above.exit_code, 5);
    EXPECT_THAT(above.output, HasSubstr("bias is 0.2"));
    // An image that is too dark fails a limit on the bias as one that is too bright does.
    EXPECT_EQ(compare({"a.exr", "b.exr", "--fail-above", "bias=0.1"}).exit_code, 5);
}

TEST_F(CompareCommand, NotANumberFailsAnyThreshold) {
    write(std::numeric_limits<float>::quiet_NaN(), "nan.exr");
    EXPECT_EQ(compare({"nan.exr", "a.exr"}).exit_code, 0) << "without a threshold it only reports";
    const ProcessResult result = compare({"nan.exr", "a.exr", "--fail-above", "relmse=1000000"});
    EXPECT_EQ(result.exit_code, 5);
    EXPECT_THAT(result.output, HasSubstr("576 values are NaN"));
}

TEST_F(CompareCommand, RefusesBadThresholds) {
    for (const char* threshold :
         {"nonsense=1", "relmse", "relmse=", "relmse=abc", "relmse=-1", "ssim=0.5", "=1"}) {
        const ProcessResult result = compare({"b.exr", "a.exr", "--fail-above", threshold});
        EXPECT_EQ(result.exit_code, 2) << threshold << ": " << result.output;
        EXPECT_THAT(result.output, HasSubstr("--fail-above")) << threshold;
    }
}

TEST_F(CompareCommand, RefusesImagesThatCannotBeCompared) {
    write(0.5F, "wide.exr", 17);
    const ProcessResult sizes = compare({"wide.exr", "a.exr"});
    EXPECT_EQ(sizes.exit_code, 3);
    EXPECT_THAT(sizes.output, HasSubstr("17x12 but the reference is 16x12"));
    const ProcessResult missing = compare({"missing.exr", "a.exr"});
    EXPECT_EQ(missing.exit_code, 3);
    EXPECT_THAT(missing.output, HasSubstr("missing.exr"));
}

TEST_F(CompareCommand, ExposureScalesBothBeforeTheyAreCompared) {
    // (0.1 f)^2 / ((0.6 f)^2 + 0.01), f = 1 and 2^-1; 0.6 as a half.
    EXPECT_THAT(compare({"a.exr", "b.exr"}).output, HasSubstr("relmse          0.0270"));
    const ProcessResult darker = compare({"a.exr", "b.exr", "--exposure", "-1"});
    EXPECT_THAT(darker.output, HasSubstr("relmse          0.0250"));
    EXPECT_THAT(darker.output, HasSubstr("bias            -0.1668"));
    EXPECT_EQ(compare({"a.exr", "b.exr", "--exposure", "65"}).exit_code, 2);
    EXPECT_EQ(compare({"a.exr", "b.exr", "--exposure", "nan"}).exit_code, 2);
}

TEST_F(CompareCommand, PngIsDecodedToLinear) {
    write(0.735357F, "a.png");  // what 0.5 looks like
    const ProcessResult result = compare({"a.png", "a.exr", "--fail-above", "relmse=1e-4"});
    EXPECT_EQ(result.exit_code, 0) << result.output;
}

}  // namespace
}  // namespace bounce
