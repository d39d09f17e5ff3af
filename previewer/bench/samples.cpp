// SPDX-License-Identifier: Apache-2.0
#include "bench/samples.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace bounce::bench {

double Samples::best() const {
    return ms.empty() ? std::numeric_limits<double>::quiet_NaN() : *std::min_element(ms.begin(), ms.end());
}

double Samples::median() const {
    if (ms.empty()) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    std::vector<double> sorted = ms;
    std::sort(sorted.begin(), sorted.end());
    const size_t middle = sorted.size() / 2;
    return sorted.size() % 2 == 1 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
}

void Samples::add(const Samples& other) {
    if (ms.empty()) {
        ms = other.ms;
        return;
    }
    assert(ms.size() == other.ms.size());
    for (size_t i = 0; i < ms.size(); ++i) {
        ms[i] += other.ms[i];
    }
}

double millions_a_second(double count, double ms) {
    return ms > 0.0 ? count / (ms * 1e3) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace bounce::bench
