// SPDX-License-Identifier: Apache-2.0
#include "image/temporal_spectrum.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace bounce {
namespace {

// The window and the rows of the transform's matrix, made once for all pixels. Direct, not fast: sequences
// are short, and only the high half of the frequencies is needed.
class HighTransform {
  public:
    explicit HighTransform(size_t count) : count_(count) {
        const auto n = static_cast<double>(count);
        double squares = 0.0;
        for (size_t t = 0; t < count; ++t) {
            // Half a frame in from both ends, so that no frame weighs nothing.
            const double s = std::sin(std::numbers::pi * (static_cast<double>(t) + 0.5) / n);
            window_.push_back(s * s);
            squares += s * s * s * s;
        }
        // Over the squares' sum instead of the count: what the window takes away is put back.
        scale_ = 1.0 / squares;
        for (size_t k = 0; k <= count / 2; ++k) {
            if (4 * k <= count) {
                continue;
            }
            // A real signal has the same energy at k and at count - k.
            weight_.push_back(2 * k == count ? 1.0 : 2.0);
            for (size_t t = 0; t < count; ++t) {
                const double angle = 2.0 * std::numbers::pi * static_cast<double>(k * t % count) / n;
                cosines_.push_back(std::cos(angle));
                sines_.push_back(std::sin(angle));
            }
        }
    }

    // The signal is changed.
    TemporalEnergy operator()(std::vector<double>& signal) const {
        // From the first value on: what does not change at all has no energy, not even by rounding.
        const double first = signal.front();
        double mean = 0.0;
        for (double& value : signal) {
            value -= first;
            mean += value;
        }
        mean /= static_cast<double>(count_);
        TemporalEnergy energy;
        double constant = 0.0;
        for (size_t t = 0; t < count_; ++t) {
            signal[t] = (signal[t] - mean) * window_[t];
            energy.total += signal[t] * signal[t];
            constant += signal[t];
        }
        // Without frequency 0, which the window has made of the others.
        energy.total -= constant * constant / static_cast<double>(count_);
        energy.total = scale_ * std::max(energy.total, 0.0);
        for (size_t row = 0; row < weight_.size(); ++row) {
            double real = 0.0;
            double imaginary = 0.0;
            for (size_t t = 0; t < count_; ++t) {
                real += signal[t] * cosines_[row * count_ + t];
                imaginary += signal[t] * sines_[row * count_ + t];
            }
            energy.high += weight_[row] * (real * real + imaginary * imaginary);
        }
        energy.high *= scale_ / static_cast<double>(count_);
        return energy;
    }

  private:
    size_t count_;
    double scale_ = 0.0;
    std::vector<double> window_, weight_, cosines_, sines_;
};

}  // namespace

TemporalEnergy temporal_energy(const std::vector<double>& signal) {
    assert(signal.size() >= k_least_spectrum_frames);
    std::vector<double> work = signal;
    return HighTransform(signal.size())(work);
}

TemporalEnergy mean_temporal_energy(const std::vector<Plane>& frames, const std::vector<char>& mask) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    if (frames.size() < k_least_spectrum_frames) {
        return {nan, nan};
    }
    const HighTransform transform(frames.size());
    std::vector<double> signal(frames.size());
    TemporalEnergy sum;
    size_t pixels = 0;
    for (size_t i = 0; i < frames.front().values.size(); ++i) {
        if (!mask.empty() && mask[i] == 0) {
            continue;
        }
        for (size_t t = 0; t < frames.size(); ++t) {
            signal[t] = static_cast<double>(frames[t].values[i]);
        }
        const TemporalEnergy energy = transform(signal);
        sum.high += energy.high;
        sum.total += energy.total;
        ++pixels;
    }
    if (pixels == 0) {
        return {nan, nan};
    }
    const auto count = static_cast<double>(pixels);
    return {sum.high / count, sum.total / count};
}

}  // namespace bounce
