// SPDX-License-Identifier: Apache-2.0
#include "cli/thresholds.h"

#include <charconv>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "core/error.h"
#include "core/log.h"

namespace bounce::cli {
namespace {

std::string known_names(bool sequence) {
    std::string names;
    for (const NamedMetric& known : named_metrics()) {
        if (known.lower_is_better) {
            names += fmt::format("{}{}", names.empty() ? "" : ", ", known.name);
        }
    }
    if (sequence) {
        for (const NamedSequenceMetric& known : named_sequence_metrics()) {
            names += fmt::format(", {}", known.name);
        }
    }
    return names;
}

Threshold parse_threshold(const std::string& text, bool sequence) {
    const size_t equals = text.find('=');
    const std::string_view name = std::string_view(text).substr(0, equals);
    const auto metric = find_metric(name);
    const auto of_sequence = find_sequence_metric(name);
    if (of_sequence && !sequence) {
        throw usage_error(
            fmt::format("--fail-above {}: {} is of sequences; put #### where the names have the frame number",
                        text, name));
    }
    if (!of_sequence && (!metric || !metric->lower_is_better)) {
        throw usage_error(fmt::format("--fail-above {}: {}; the metrics with an upper limit are {}", text,
                                      metric ? "more is better for this metric" : "no such metric",
                                      known_names(sequence)));
    }
    double limit = 0.0;
    const char* end = text.data() + text.size();
    const char* start = equals == std::string::npos ? end : text.data() + equals + 1;
    const auto [parsed, error] = std::from_chars(start, end, limit);
    if (error != std::errc{} || parsed != end || !(limit >= 0.0)) {
        throw usage_error(
            fmt::format("--fail-above {}: give a limit of 0 or more, as in {}=0.01", text, name));
    }
    if (of_sequence) {
        return {*of_sequence, limit};
    }
    return {*metric, limit};
}

void report(const std::string& what, const Threshold& threshold, double value, size_t nan, size_t inf) {
    const std::string why = nan + inf > 0
                                ? fmt::format("cannot be told: {} values are NaN and {} infinite", nan, inf)
                                : fmt::format("is {:.6g}", value);
    log::error("{}: {} {}, the limit is {:g}", what, threshold.name(), why, threshold.limit);
}

}  // namespace

std::string_view Threshold::name() const {
    return std::visit([](const auto& named) { return named.name; }, metric);
}

std::vector<Threshold> parse_thresholds(const std::vector<std::string>& texts, bool sequence) {
    std::vector<Threshold> thresholds;
    thresholds.reserve(texts.size());
    for (const std::string& text : texts) {
        thresholds.push_back(parse_threshold(text, sequence));
    }
    return thresholds;
}

bool report_exceeded(const std::vector<Threshold>& thresholds, const Metrics& metrics,
                     const std::string& what) {
    bool any = false;
    for (const Threshold& threshold : thresholds) {
        const auto& metric = std::get<NamedMetric>(threshold.metric);
        if (exceeds(metrics, metric, threshold.limit)) {
            report(what, threshold, metric.value(metrics), metrics.nan, metrics.inf);
            any = true;
        }
    }
    return any;
}

bool report_exceeded(const std::vector<Threshold>& thresholds, const SequenceMetrics& metrics,
                     const std::string& what) {
    bool any = false;
    for (const Threshold& threshold : thresholds) {
        if (const auto* named = std::get_if<NamedSequenceMetric>(&threshold.metric)) {
            const double value = named->value(metrics);
            if (metrics.nan + metrics.inf > 0 || !(value <= threshold.limit)) {  // NaN counts as above
                report(what, threshold, value, metrics.nan, metrics.inf);
                any = true;
            }
            continue;
        }
        const auto& named = std::get<NamedMetric>(threshold.metric);
        const SequenceFrame* worst = worst_frame(metrics, named);
        if (worst != nullptr && exceeds(*worst->error, named, threshold.limit)) {
            report(fmt::format("{}, frame {}", what, worst->frame), threshold, named.value(*worst->error),
                   worst->error->nan, worst->error->inf);
            any = true;
        }
    }
    return any;
}

}  // namespace bounce::cli
