// SPDX-License-Identifier: Apache-2.0
#include "evaluate/machine.h"

#include <gtest/gtest.h>

namespace bounce {
namespace {

TEST(ShellLine, QuotesWhatAShellWouldReadOtherwise) {
    EXPECT_EQ(shell_line({"bounce", "evaluate", "a b.blend", "--frames", "1,24", "it's", "$x", ""}),
              "bounce evaluate 'a b.blend' --frames 1,24 'it'\\''s' '$x' ''");
}

TEST(Machine, IsDescribed) {
    const Machine machine = this_machine();
    EXPECT_FALSE(machine.cpu.empty());
    EXPECT_GE(machine.threads, 1);
    EXPECT_FALSE(machine.system.empty());
    EXPECT_NE(this_command().find("test_evaluate"), std::string::npos);
}

}  // namespace
}  // namespace bounce
