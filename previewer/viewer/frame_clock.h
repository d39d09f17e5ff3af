// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace bounce::viewer {

// The median time of the last frames: one slow frame (a shader compiled, another program busy) does not
// move it.
class FrameClock {
  public:
    void add(double ms) {
        times_[next_] = ms;
        next_ = (next_ + 1) % times_.size();
        count_ = std::min(count_ + 1, times_.size());
    }
    // When what a frame costs has changed.
    void clear() { count_ = next_ = 0; }
    // 0 where there was no frame.
    [[nodiscard]] double median_ms() const {
        if (count_ == 0) {
            return 0.0;
        }
        auto sorted = times_;
        const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(count_);
        const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(count_ / 2);
        std::nth_element(sorted.begin(), middle, end);
        if (count_ % 2 == 1) {
            return *middle;
        }
        return 0.5 * (*middle + *std::max_element(sorted.begin(), middle));
    }

  private:
    std::array<double, 30> times_{};
    size_t count_ = 0;
    size_t next_ = 0;
};

}  // namespace bounce::viewer
