// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

namespace bounce::cli {

// Settings::drop_hull by name.
[[nodiscard]] const std::map<std::string, bool>& hull_names();

}  // namespace bounce::cli
