// SPDX-License-Identifier: Apache-2.0
#include "stress/stress.h"

#include <cctype>
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "gl/context.h"

namespace bounce::stress {

// For GoogleTest, which else prints bytes.
inline void PrintTo(const StressCase& of, std::ostream* out) {
    *out << of.name;
}

namespace {

class Stress : public testing::TestWithParam<StressCase> {
  protected:
    static void SetUpTestSuite() {
        static const gl::HeadlessContext context;
        static const gl::DeviceInfo device = gl::initialise_current_context();
        ASSERT_FALSE(device.renderer.empty());
    }
};

TEST_P(Stress, ComesOutAsExpected) {
    const StressCase& of = GetParam();
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / fmt::format("bounce stress {}", getpid());
    std::filesystem::create_directories(folder);
    StressRun run(folder, Size::small, false);
    const StressResult result = run_case(of, run);
    std::filesystem::remove_all(folder);
    EXPECT_TRUE(result.verdict.as_expected)
        << of.name << "\n  expected: " << of.expected << "\n  got: " << result.verdict.got;
    EXPECT_TRUE(result.finite) << of.name << ": " << result.verdict.got;
    std::printf("%-45s %s (%.2f s)\n", of.name.c_str(), result.verdict.got.c_str(), result.seconds);
}

std::string name_of_test(const testing::TestParamInfo<StressCase>& info) {
    std::string out;
    for (const char c : info.param.name) {
        out += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    }
    return out;
}

INSTANTIATE_TEST_SUITE_P(Cases, Stress, testing::ValuesIn(stress_cases()), name_of_test);

}  // namespace
}  // namespace bounce::stress
