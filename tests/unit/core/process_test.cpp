// SPDX-License-Identifier: Apache-2.0
#include "core/process.h"

#include <vector>

#include <gtest/gtest.h>

#include "core/error.h"

namespace bounce {
namespace {

TEST(ProcessTest, OutputAndExitCode) {
    const ProcessResult result = run_process({"sh", "-c", "echo out; echo err >&2; exit 3"});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_EQ(result.output, "out\nerr\n");
    EXPECT_GE(result.seconds, 0.0);
}

TEST(ProcessTest, ArgumentsPassNoShell) {
    const ProcessResult result = run_process({"printf", "%s|", "a b", "$HOME", "*"});
    EXPECT_EQ(result.output, "a b|$HOME|*|");
}

TEST(ProcessTest, LinesAsTheyCome) {
    std::vector<std::string> lines;
    run_process({"printf", "one\\ntwo\\rthree"}, [&](std::string_view line) { lines.emplace_back(line); });
    EXPECT_EQ(lines, (std::vector<std::string>{"one", "two", "three"}));
}

TEST(ProcessTest, SignalsAndMissingPrograms) {
    EXPECT_EQ(run_process({"sh", "-c", "kill -9 $$"}).exit_code, 128 + 9);
    EXPECT_THROW(run_process({"bounce-no-such-program"}), Error);
}

TEST(ProcessTest, StandardInputIsEmpty) {
    EXPECT_EQ(run_process({"cat"}).output, "");
}

TEST(ProcessTest, FindsPrograms) {
    EXPECT_TRUE(find_program("sh").has_value());
    EXPECT_TRUE(find_program("/bin/sh").has_value());
    EXPECT_FALSE(find_program("bounce-no-such-program").has_value());
    EXPECT_FALSE(find_program("/no/such/program").has_value());
    EXPECT_TRUE(std::filesystem::exists(executable_folder() / "test_core"));
}

}  // namespace
}  // namespace bounce
