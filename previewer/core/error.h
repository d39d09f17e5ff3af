// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace bounce {

// What the process returns; the command line promises these numbers (docs/architecture.md, "Errors").
enum class ExitCode : int {
    done = 0,
    failed = 1,
    usage = 2,
    input_refused = 3,
    no_opengl = 4,
    above_threshold = 5,
    interrupted = 130,  // 128 + SIGINT, as shells report it
    terminated = 143,   // 128 + SIGTERM
};

// A failure the user can do something about. The message is one sentence: what, where, what to do.
// Three kinds of error exist here: assert for our own mistakes, Error for bad input and a hostile
// machine, return values where failure is an ordinary answer.
class Error : public std::runtime_error {
  public:
    Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
    [[nodiscard]] ExitCode code() const noexcept { return code_; }

  private:
    ExitCode code_;
};

// Shorthands, so that a throw reads as a sentence.
[[nodiscard]] inline Error input_error(const std::string& message) {
    return {ExitCode::input_refused, message};
}
[[nodiscard]] inline Error output_error(const std::string& message) {
    return {ExitCode::failed, message};
}
[[nodiscard]] inline Error usage_error(const std::string& message) {
    return {ExitCode::usage, message};
}

}  // namespace bounce
