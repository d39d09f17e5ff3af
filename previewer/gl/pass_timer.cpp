// SPDX-License-Identifier: Apache-2.0
#include "gl/pass_timer.h"

namespace bounce::gl {
namespace {

double milliseconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

void PassTimer::begin(const std::string& name) {
    if (mode_ == TimingMode::off) {
        return;
    }
    passes_.push_back({name, 0.0, 0.0});
    if (mode_ == TimingMode::finish) {
        glFinish();
    } else {
        GLuint id = 0;
        glCreateQueries(GL_TIME_ELAPSED, 1, &id);
        queries_.emplace_back(id);
        glBeginQuery(GL_TIME_ELAPSED, id);
    }
    start_ = std::chrono::steady_clock::now();
}

void PassTimer::end() {
    if (mode_ == TimingMode::off) {
        return;
    }
    passes_.back().cpu_ms = milliseconds_since(start_);
    if (mode_ == TimingMode::finish) {
        glFinish();
        passes_.back().gpu_ms = milliseconds_since(start_);
    } else {
        glEndQuery(GL_TIME_ELAPSED);
    }
}

std::vector<PassTime> PassTimer::collect() {
    for (size_t i = 0; i < queries_.size(); ++i) {
        GLuint64 nanoseconds = 0;
        glGetQueryObjectui64v(queries_[i].id(), GL_QUERY_RESULT, &nanoseconds);
        passes_[i].gpu_ms = static_cast<double>(nanoseconds) * 1e-6;
    }
    queries_.clear();
    return std::exchange(passes_, {});
}

}  // namespace bounce::gl
