// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace bounce {

// Progress of long work on stderr: a bar that is redrawn in place on a terminal, one line a step elsewhere.
// Both tell the time left, as if all steps took the same.
class Progress {
  public:
    Progress(std::string title, int total);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    Progress(Progress&&) = delete;
    Progress& operator=(Progress&&) = delete;

    // One step is done; note says which ("frame 12, 41 ms").
    void step(std::string_view note);
    // One step was done by an earlier run: it says nothing of how long the others take.
    void found(std::string_view note);

  private:
    void print(std::string_view note) const;

    std::string title_;
    int total_;
    int done_ = 0;
    int found_ = 0;  // of these, by an earlier run
    bool terminal_;
    std::chrono::steady_clock::time_point start_;
};

// "45 s", "12 min", "1 h 5 min".
[[nodiscard]] std::string rough_time(double seconds);

}  // namespace bounce
