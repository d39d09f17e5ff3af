// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace bounce::gl {

inline constexpr double k_mebibyte = 1024.0 * 1024.0;

// Counts what we ask of the driver for as long as it lives. The driver's own overhead is not in it.
class Allocation {
  public:
    Allocation() = default;
    explicit Allocation(size_t bytes);
    ~Allocation();
    Allocation(const Allocation&) = delete;
    Allocation& operator=(const Allocation&) = delete;
    Allocation(Allocation&& other) noexcept;
    Allocation& operator=(Allocation&& other) noexcept;

  private:
    size_t bytes_ = 0;
};

// Alive now, and the most that was alive at once, in this process.
[[nodiscard]] size_t allocated_bytes();
[[nodiscard]] size_t peak_allocated_bytes();
// From now on the peak is of what comes.
void restart_peak();

}  // namespace bounce::gl
