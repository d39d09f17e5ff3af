// SPDX-License-Identifier: Apache-2.0
#include "core/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace bounce {

Progress::Progress(std::string title, int total)
    : title_(std::move(title)),
      total_(std::max(total, 1)),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()) {}

Progress::~Progress() {
    if (terminal_ && done_ > 0) {
        std::fputc('\n', stderr);
    }
}

void Progress::step(std::string_view note) {
    ++done_;
    print(note);
}

void Progress::found(std::string_view note) {
    ++done_;
    ++found_;
    print(note);
}

void Progress::print(std::string_view note) const {
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const int timed = done_ - found_;
    const std::string left = timed > 0 && done_ < total_
                                 ? fmt::format("{} left", rough_time(elapsed / timed * (total_ - done_)))
                                 : "";
    if (!terminal_) {
        fmt::print(stderr, "{} {}/{}: {}{}\n", title_, done_, total_, note, left.empty() ? "" : "; " + left);
        return;
    }
    constexpr int width = 24;
    const int filled = std::clamp(width * done_ / total_, 0, width);
    // \x1b[K clears what a longer line before left behind.
    fmt::print(stderr, "\r{} [{:#<{}}{:.<{}}] {}/{} {}{}{}\x1b[K", title_, "", filled, "", width - filled,
               done_, total_, note, left.empty() ? "" : ", ", left);
    std::fflush(stderr);
}

std::string rough_time(double seconds) {
    const auto whole = std::max(std::llround(seconds), 0LL);
    if (whole < 90) {
        return fmt::format("{} s", whole);
    }
    const long long minutes = (whole + 30) / 60;
    return minutes < 60 ? fmt::format("{} min", minutes)
                        : fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

}  // namespace bounce
