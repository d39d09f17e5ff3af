// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "image/sequence_metrics.h"

namespace bounce {

// The object that `bounce compare --json` writes of a sequence: {schema, frames[...], mean{...}, worst{...},
// sequence{...}}. frames[] holds what metrics_to_json gives and the steps; mean and worst are there with a
// reference. What is not finite becomes null.
[[nodiscard]] nlohmann::ordered_json sequence_to_json(const SequenceMetrics& metrics);

// Its member "sequence" alone: the figures of the whole.
[[nodiscard]] nlohmann::ordered_json sequence_figures_json(const SequenceMetrics& metrics);

// Mean over the frames of a metric against the reference; NaN where there is none.
[[nodiscard]] double mean_over_frames(const SequenceMetrics& metrics, const NamedMetric& metric);

}  // namespace bounce
