// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/process.h"
#include "temporary_folder.h"

namespace bounce {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

ProcessResult evaluate(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {BOUNCE_BINARY_DIR "/bounce", "evaluate"});
    return run_process(arguments);
}

TEST(EvaluateCommand, RefusesBadArguments) {
    const TemporaryFolder folder;
    const std::string out = (folder / "report").string();
    for (const std::vector<std::string>& wrong :
         std::vector<std::vector<std::string>>{{"--reference-spp", "63"},
                                               {"--reference-spp", "0"},
                                               {"--frames", "one"},
                                               {"--size", "640"},
                                               {"--cycles-spp", "0,4"},
                                               {"--bounces", "-1"},
                                               {"--repeat", "0"}}) {
        std::vector<std::string> arguments{"scene.glb", "-o", out};
        arguments.insert(arguments.end(), wrong.begin(), wrong.end());
        const ProcessResult result = evaluate(arguments);
        EXPECT_EQ(result.exit_code, 2) << wrong[0] << " " << wrong[1] << ": " << result.output;
    }
    EXPECT_EQ(evaluate({"scene.glb"}).exit_code, 2) << "without -o";
    EXPECT_FALSE(std::filesystem::exists(folder / "report")) << "a refused command left a folder";
}

TEST(EvaluateCommand, SaysWhatIsMissing) {
    const TemporaryFolder folder;
    const ProcessResult no_scene =
        evaluate({(folder / "missing.blend").string(), "-o", (folder / "report").string()});
    EXPECT_EQ(no_scene.exit_code, 3);
    EXPECT_THAT(no_scene.output, HasSubstr("missing.blend"));
    std::ofstream(folder / "a.glb") << "glTF";
    const ProcessResult no_blender = evaluate(
        {(folder / "a.glb").string(), "-o", (folder / "report").string(), "--blender", "/no/blender"});
    EXPECT_EQ(no_blender.exit_code, 1);
    EXPECT_THAT(no_blender.output, HasSubstr("--blender /no/blender: there is no such program"));
    const ProcessResult no_folder =
        evaluate({(folder / "a.glb").string(), "-o", (folder / "a.glb").string()});
    EXPECT_EQ(no_folder.exit_code, 1);
    EXPECT_THAT(no_folder.output, HasSubstr("a.glb"));
}

}  // namespace
}  // namespace bounce
