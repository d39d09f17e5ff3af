// SPDX-License-Identifier: Apache-2.0
//
// Sequences of frames with a reference each, which several settings are held against.
#pragma once

#include <string>
#include <vector>

#include "bench/motions.h"
#include "image/sequence_metrics.h"
#include "renderer/renderer.h"

namespace bounce::bench {

struct Walk {
    std::string name;  // of the motion
    std::vector<Shot> shots;
    std::vector<Image> references;
    std::vector<Image> motions;  // the layer of each frame; empty in the first
};

// One frame. before: for the layer of motion.
[[nodiscard]] Image draw_shot(const BenchInputs& inputs, Renderer& renderer, const Shot& shot,
                              const Settings& settings, const Moment* before = nullptr);

// Draws references and where surfaces were. reference: settings of the pictures held for right.
[[nodiscard]] Walk make_walk(const BenchInputs& inputs, Renderer& renderer, const Motion& motion, int frames,
                             const Settings& reference);

// The walk by these settings against its references.
[[nodiscard]] SequenceMetrics run_walk(const BenchInputs& inputs, Renderer& renderer, const Walk& walk,
                                       const Settings& settings);

// Mean of the frames' root-mean-square errors, each over the root mean square of its reference.
[[nodiscard]] double mean_nrmse(const SequenceMetrics& metrics);
// Mean of their differences in mean, over the reference's.
[[nodiscard]] double mean_bias(const SequenceMetrics& metrics);

}  // namespace bounce::bench
