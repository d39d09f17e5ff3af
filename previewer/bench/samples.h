// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace bounce::bench {

// Repeated measurements of one time, in milliseconds, in the order they were taken. Where there are none,
// best and median are NaN: a time that was not taken is no time of 0.
struct Samples {
    std::vector<double> ms;

    // The smallest: what the machine can do where others' work only ever adds to a time.
    [[nodiscard]] double best() const;
    // The middle one; of an even number the mean of the middle two.
    [[nodiscard]] double median() const;
    // Adds the other's times one by one; both were taken in the same frames, or this one is still empty.
    void add(const Samples& other);
};

// Millions a second of `count` things done in some milliseconds; NaN where the time is not above 0.
[[nodiscard]] double millions_a_second(double count, double ms);

}  // namespace bounce::bench
