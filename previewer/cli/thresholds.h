// SPDX-License-Identifier: Apache-2.0
//
// --fail-above of compare.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "image/sequence_metrics.h"

namespace bounce::cli {

struct Threshold {
    std::variant<NamedMetric, NamedSequenceMetric> metric;
    double limit = 0.0;

    [[nodiscard]] std::string_view name() const;
};

// "relmse=0.01" each. Throws usage_error: no such metric, no limit, or one of sequences where a single image
// is compared.
[[nodiscard]] std::vector<Threshold> parse_thresholds(const std::vector<std::string>& texts, bool sequence);

// Says on stderr which limits are exceeded; true where any is.
[[nodiscard]] bool report_exceeded(const std::vector<Threshold>& thresholds, const Metrics& metrics,
                                   const std::string& what);
// A metric of images counts in the worst frame.
[[nodiscard]] bool report_exceeded(const std::vector<Threshold>& thresholds, const SequenceMetrics& metrics,
                                   const std::string& what);

}  // namespace bounce::cli
