// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "image/metrics.h"

namespace bounce {

// The object that `bounce compare --json` writes. A value that is not finite (any error where the image
// has a NaN, PSNR of equal images) becomes null.
[[nodiscard]] nlohmann::ordered_json metrics_to_json(const Metrics& metrics);

}  // namespace bounce
