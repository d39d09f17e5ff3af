// SPDX-License-Identifier: Apache-2.0
#include "core/process.h"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.h"

extern char** environ;  // NOLINT: POSIX names it so

namespace bounce {
namespace fs = std::filesystem;

ProcessResult run_process(const std::vector<std::string>& command,
                          const std::function<void(std::string_view)>& on_line) {
    const auto start = std::chrono::steady_clock::now();
    std::array<int, 2> pipe_ends{};
    if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) {
        throw Error(ExitCode::failed, fmt::format("cannot create a pipe: {}", std::strerror(errno)));
    }
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDERR_FILENO);

    std::vector<std::string> storage = command;
    std::vector<char*> arguments;
    arguments.reserve(storage.size() + 1);
    for (std::string& argument : storage) {
        arguments.push_back(argument.data());
    }
    arguments.push_back(nullptr);

    pid_t child = 0;
    const int spawn_error = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(pipe_ends[1]);
    if (spawn_error != 0) {
        close(pipe_ends[0]);
        throw Error(ExitCode::failed,
                    fmt::format("cannot start {}: {}", command[0], std::strerror(spawn_error)));
    }

    ProcessResult result;
    std::string line;
    std::array<char, 4096> buffer{};
    for (;;) {
        const ssize_t count = read(pipe_ends[0], buffer.data(), buffer.size());
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count <= 0) {
            break;
        }
        const std::string_view chunk(buffer.data(), static_cast<size_t>(count));
        result.output += chunk;
        if (on_line) {
            for (const char c : chunk) {
                if (c == '\n' || c == '\r') {
                    on_line(line);
                    line.clear();
                } else {
                    line += c;
                }
            }
        }
    }
    if (on_line && !line.empty()) {
        on_line(line);
    }
    close(pipe_ends[0]);

    int status = 0;
    rusage usage{};
    while (wait4(child, &status, 0, &usage) < 0 && errno == EINTR) {
    }
    const auto peak = static_cast<size_t>(usage.ru_maxrss) * 1024U;  // Linux counts kibibytes
    result.rss_peak_bytes = peak > peak_resident_bytes() ? peak : 0;
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

size_t peak_resident_bytes() {
    std::ifstream in("/proc/self/status");
    std::string word;
    while (in >> word) {
        size_t kibibytes = 0;
        if (word == "VmHWM:" && in >> kibibytes) {
            return kibibytes * 1024U;
        }
    }
    return 0;
}

std::optional<fs::path> find_program(std::string_view name) {
    std::error_code ignored;
    if (name.find('/') != std::string_view::npos) {
        return access(std::string(name).c_str(), X_OK) == 0 ? std::optional<fs::path>(name) : std::nullopt;
    }
    const char* variable = std::getenv("PATH");
    std::string_view paths = variable != nullptr ? variable : "/usr/local/bin:/usr/bin:/bin";
    while (!paths.empty()) {
        const size_t end = std::min(paths.find(':'), paths.size());
        const fs::path candidate = fs::path(paths.substr(0, end)) / name;
        if (fs::is_regular_file(candidate, ignored) && access(candidate.c_str(), X_OK) == 0) {
            return candidate;
        }
        paths.remove_prefix(std::min(end + 1, paths.size()));
    }
    return std::nullopt;
}

fs::path executable_path() {
    return fs::read_symlink("/proc/self/exe");
}

fs::path executable_folder() {
    return executable_path().parent_path();
}

}  // namespace bounce
