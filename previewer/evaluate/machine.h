// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace bounce {

// What times were measured on.
struct Machine {
    std::string cpu;  // the processor's name, "unknown" where the system does not tell
    int threads = 0;  // hardware threads this process may use
    std::string system;
};

[[nodiscard]] Machine this_machine();

// The command line of this process, quoted so that a shell reads it back.
[[nodiscard]] std::string this_command();

// The words as one line for a shell.
[[nodiscard]] std::string shell_line(const std::vector<std::string>& words);

}  // namespace bounce
