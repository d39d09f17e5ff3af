// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace bounce {

// While it lives, Ctrl-C (SIGINT) and SIGTERM do not end the process but are remembered, so that work stops
// between two steps and its temporary files are removed on the way out. A second signal ends the process at
// once. One at a time.
class InterruptGuard {
  public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;
    InterruptGuard(InterruptGuard&&) = delete;
    InterruptGuard& operator=(InterruptGuard&&) = delete;

    // Throws Error with exit code 128 + signal, as a shell reports a process that a signal ended. `state`
    // says what there is by now ("2 of 48 frames are written").
    void throw_if_interrupted(std::string_view state) const;
    // Whether a signal has come.
    [[nodiscard]] static bool interrupted();
};

}  // namespace bounce
