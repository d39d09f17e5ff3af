// SPDX-License-Identifier: Apache-2.0
#include "image/metrics_json.h"

#include <cmath>
#include <string>

namespace bounce {
namespace {

nlohmann::ordered_json number(double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

}  // namespace

nlohmann::ordered_json metrics_to_json(const Metrics& metrics) {
    nlohmann::ordered_json json;
    for (const NamedMetric& metric : named_metrics()) {
        json[std::string(metric.name)] = number(metric.value(metrics));
    }
    json["nan"] = metrics.nan;  // counts, not floats
    json["inf"] = metrics.inf;
    json["width"] = metrics.width;
    json["height"] = metrics.height;
    json["bias_rgb"] = {number(metrics.bias_rgb[0]), number(metrics.bias_rgb[1]),
                        number(metrics.bias_rgb[2])};
    json["max_abs_pixel"] = {metrics.max_abs_x, metrics.max_abs_y};
    json["flip_hdr_exposures"] = {{"start", metrics.flip_hdr_start_exposure},
                                  {"stop", metrics.flip_hdr_stop_exposure},
                                  {"count", metrics.flip_hdr_exposures}};
    return json;
}

}  // namespace bounce
