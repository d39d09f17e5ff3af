// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bounce {

struct ProcessResult {
    int exit_code = 0;   // 128 + signal where a signal ended it
    std::string output;  // stdout and stderr, interleaved
    double seconds = 0.0;
    // The largest resident memory of the program or of one it waited for. A new process inherits the mark of
    // the one that started it, so what is not above our own is not told: 0.
    size_t rss_peak_bytes = 0;
};

// Runs a program without a shell and waits for it. on_line, where given, sees each line of output as
// it comes. Throws Error (failed) where the program cannot be started.
ProcessResult run_process(const std::vector<std::string>& command,
                          const std::function<void(std::string_view line)>& on_line = {});

// The largest resident memory of this process so far (VmHWM of /proc/self/status), 0 where the system does
// not tell.
[[nodiscard]] size_t peak_resident_bytes();

// The program's full path on $PATH, or nothing.
std::optional<std::filesystem::path> find_program(std::string_view name);

// The running executable, and the folder that holds it.
std::filesystem::path executable_path();
std::filesystem::path executable_folder();

}  // namespace bounce
