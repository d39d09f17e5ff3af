// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace bounce::cli {

// "1-48", "1,24", "1-48x4" (every fourth), or several joined by commas, as frame numbers in that order.
// Throws usage_error.
[[nodiscard]] std::vector<int> parse_frames(const std::string& text);

// "640x360". Throws usage_error for anything else, or sizes OpenGL cannot draw.
[[nodiscard]] std::pair<int, int> parse_size(const std::string& text);

// The name with its run of # replaced by the zero-padded frame number.
[[nodiscard]] std::filesystem::path frame_path(const std::string& pattern, int frame);
[[nodiscard]] bool has_frame_field(const std::string& pattern);

}  // namespace bounce::cli
