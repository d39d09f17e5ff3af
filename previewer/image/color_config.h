// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

namespace bounce {

// Where an OpenColorIO configuration may be, in the order in which Blender itself asks: $OCIO, which need not
// be a file that exists, then colormanagement/config.ocio in the datafiles of $BLENDER or of the `blender` on
// $PATH. Empty where neither is there.
[[nodiscard]] std::vector<std::filesystem::path> color_config_candidates();

// The first of them.
[[nodiscard]] std::optional<std::filesystem::path> find_color_config();

// The configuration that belongs to a Blender executable, in a portable folder (blender, 3.4/datafiles)
// or under a prefix (bin/blender, share/blender/datafiles or share/blender/3.4/datafiles).
[[nodiscard]] std::optional<std::filesystem::path> color_config_of_blender(
    const std::filesystem::path& blender_executable);

}  // namespace bounce
