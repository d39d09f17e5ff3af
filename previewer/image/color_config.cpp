// SPDX-License-Identifier: Apache-2.0
#include "image/color_config.h"

#include <cstdlib>
#include <system_error>
#include <utility>

#include "core/process.h"

namespace bounce {
namespace fs = std::filesystem;
namespace {

std::optional<fs::path> config_in(const fs::path& folder) {
    std::error_code ignored;
    const fs::path config = folder / "datafiles" / "colormanagement" / "config.ocio";
    return fs::is_regular_file(config, ignored) ? std::optional<fs::path>(config) : std::nullopt;
}

// In folder itself or in one of its folders named like a version ("3.4").
std::optional<fs::path> config_in_or_below(const fs::path& folder) {
    if (auto config = config_in(folder)) {
        return config;
    }
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        if (entry.path().filename().string().find('.') != std::string::npos) {
            if (auto config = config_in(entry.path())) {
                return config;
            }
        }
    }
    return std::nullopt;
}

}  // namespace

std::optional<fs::path> color_config_of_blender(const fs::path& blender_executable) {
    std::error_code code;
    const fs::path real = fs::canonical(blender_executable, code);
    if (code) {
        return std::nullopt;
    }
    if (auto config = config_in_or_below(real.parent_path())) {
        return config;
    }
    return config_in_or_below(real.parent_path().parent_path() / "share" / "blender");
}

std::vector<fs::path> color_config_candidates() {
    std::vector<fs::path> candidates;
    if (const char* config = std::getenv("OCIO"); config != nullptr && *config != '\0') {
        candidates.emplace_back(config);
    }
    const char* blender = std::getenv("BLENDER");
    const auto executable = find_program(blender != nullptr && *blender != '\0' ? blender : "blender");
    if (auto config = executable ? color_config_of_blender(*executable) : std::nullopt) {
        candidates.push_back(std::move(*config));
    }
    return candidates;
}

std::optional<fs::path> find_color_config() {
    const std::vector<fs::path> candidates = color_config_candidates();
    return candidates.empty() ? std::nullopt : std::optional(candidates.front());
}

}  // namespace bounce
