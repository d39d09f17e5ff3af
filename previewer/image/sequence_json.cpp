// SPDX-License-Identifier: Apache-2.0
#include "image/sequence_json.h"

#include <cmath>
#include <limits>
#include <string>

#include "image/metrics_json.h"

namespace bounce {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json frame_json(const SequenceFrame& entry) {
    Json json;
    json["frame"] = entry.frame;
    if (entry.error) {
        json.update(metrics_to_json(*entry.error));
    }
    json["nan"] = entry.nan;
    json["inf"] = entry.inf;
    json["flip_step"] = number(entry.flip_step);
    json["flip_step_reference"] = number(entry.flip_step_reference);
    json["tid"] = number(entry.tid);
    return json;
}

}  // namespace

Json sequence_figures_json(const SequenceMetrics& m) {
    return {{"frames", m.frames.size()},
            {"width", m.width},
            {"height", m.height},
            {"nan", m.nan},
            {"inf", m.inf},
            {"mean_luminance", number(m.mean_luminance)},
            {"flip_step_mean", number(m.flip_step_mean)},
            {"flip_step_max", number(m.flip_step_max)},
            {"flip_step_max_frame", m.flip_step_max_frame},
            {"flip_step_reference_mean", number(m.flip_step_reference_mean)},
            {"flip_step_reference_max", number(m.flip_step_reference_max)},
            {"tid", number(m.tid)},
            {"tid_relative", number(m.tid_relative)},
            {"tid_reference", number(m.tid_reference)},
            {"tid_coverage", number(m.tid_coverage)},
            {"flicker_power", number(m.flicker_power)},
            {"flicker_share", number(m.flicker_share)},
            {"flicker_pixels", number(m.flicker_pixels)}};
}

double mean_over_frames(const SequenceMetrics& metrics, const NamedMetric& metric) {
    double sum = 0.0;
    for (const SequenceFrame& entry : metrics.frames) {
        sum += entry.error ? metric.value(*entry.error) : std::numeric_limits<double>::quiet_NaN();
    }
    return sum / static_cast<double>(metrics.frames.size());
}

Json sequence_to_json(const SequenceMetrics& metrics) {
    Json json;
    json["schema"] = "bounce.compare-sequence/1";
    json["frames"] = Json::array();
    for (const SequenceFrame& entry : metrics.frames) {
        json["frames"].push_back(frame_json(entry));
    }
    for (const NamedMetric& metric : named_metrics()) {
        const SequenceFrame* worst = worst_frame(metrics, metric);
        if (worst == nullptr) {
            break;
        }
        const std::string name(metric.name);
        json["mean"][name] = number(mean_over_frames(metrics, metric));
        json["worst"][name] = {{"value", number(metric.value(*worst->error))}, {"frame", worst->frame}};
    }
    json["sequence"] = sequence_figures_json(metrics);
    return json;
}

}  // namespace bounce
