// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "gl/object.h"

namespace bounce::gl {

inline void delete_query(GLuint id) {
    glDeleteQueries(1, &id);
}

enum class TimingMode {
    off,     // nothing is measured, nothing waits
    query,   // GL_TIME_ELAPSED; the frame is not held up
    finish,  // glFinish around each pass and a steady clock: right on software drivers, slower as a whole
};

struct PassTime {
    std::string name;
    double gpu_ms = 0.0;  // query mode: the query's; finish mode: wall time between finishes
    double cpu_ms = 0.0;  // time spent in our calls
};

// Times the passes of one frame. In finish mode the frame as a whole is slower than without: its own
// time has to be taken in a run with `off`.
class PassTimer {
  public:
    explicit PassTimer(TimingMode mode) : mode_(mode) {}

    void begin(const std::string& name);
    void end();
    // Waits for outstanding queries and returns the passes in order; clears the timer.
    [[nodiscard]] std::vector<PassTime> collect();
    [[nodiscard]] TimingMode mode() const { return mode_; }

  private:
    TimingMode mode_;
    std::vector<PassTime> passes_;
    std::vector<Object<delete_query>> queries_;
    std::chrono::steady_clock::time_point start_;
};

}  // namespace bounce::gl
