// SPDX-License-Identifier: Apache-2.0
//
// The OpenColorIO configuration that view transforms come from, read. For image/view_transform.cpp alone: no
// other header names OpenColorIO's types.
#pragma once

#include <string>
#include <vector>

#include <OpenColorIO/OpenColorIO.h>

#include "image/view_transform.h"

namespace bounce {

struct DisplayConfig {
    std::string path;                       // empty where there is none
    OCIO_NAMESPACE::ConstConfigRcPtr ocio;  // null then
    std::vector<std::string> faults;        // sentences about configurations that could not be read
};

// The first of color_config_candidates() that can be read; kept until the candidates are others. No error
// where none can: faults say why.
[[nodiscard]] DisplayConfig display_config();

// OpenColorIO's own sentences may have several lines.
[[nodiscard]] std::string one_line(std::string text);

// What the configuration has; without one what needs none.
[[nodiscard]] std::vector<std::string> displays_of(const DisplayConfig& config);
[[nodiscard]] std::vector<std::string> views_of(const DisplayConfig& config, const std::string& display);
[[nodiscard]] std::vector<std::string> looks_of(const DisplayConfig& config);

}  // namespace bounce
