// SPDX-License-Identifier: Apache-2.0
//
// Flicker as energy at high temporal frequencies. Definitions in words: docs/metrics.md, "Sequences".
#pragma once

#include <cstddef>
#include <vector>

#include "image/convolution.h"

namespace bounce {

// Fewer frames have no frequency in the high half that the window's main lobe around 0 does not touch.
constexpr size_t k_least_spectrum_frames = 8;

// Energies of a signal sampled once a frame, in the signal's unit squared.
struct TemporalEnergy {
    double high = 0.0;   // at frequencies above 1/4 of a cycle a frame: periods shorter than four frames
    double total = 0.0;  // at every frequency but 0
};

// By a discrete Fourier transform of the signal less its mean, under a Hann window; by Parseval's theorem
// `total` is the window-weighted mean square less what the window makes of it at frequency 0. Slow changes,
// ramps included, stay out of `high`: the window's leakage falls with the sixth power of the frequency. A
// signal that alternates between +a and -a gives a^2 for both. Needs k_least_spectrum_frames values
// (asserted).
//   Harris, 1978, "On the use of windows for harmonic analysis with the discrete Fourier transform".
[[nodiscard]] TemporalEnergy temporal_energy(const std::vector<double>& signal);

// The same, summed over pixels and divided by their number. frames: planes of one size, in order; mask: 0
// leaves a pixel out, empty counts all. All NaN where there are too few frames or no pixel; a value that is
// not finite makes the energies NaN as well.
[[nodiscard]] TemporalEnergy mean_temporal_energy(const std::vector<Plane>& frames,
                                                  const std::vector<char>& mask);

}  // namespace bounce
