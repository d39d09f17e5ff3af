// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

namespace bounce {

// Blender's OpenColorIO configuration on this machine: $OCIO, else colormanagement/config.ocio in the
// datafiles of $BLENDER or of the `blender` on $PATH. Nothing where none is found.
[[nodiscard]] std::optional<std::filesystem::path> find_color_config();

// The configuration that belongs to a Blender executable, in a portable folder (blender, 3.4/datafiles)
// or under a prefix (bin/blender, share/blender/datafiles or share/blender/3.4/datafiles).
[[nodiscard]] std::optional<std::filesystem::path> color_config_of_blender(
    const std::filesystem::path& blender_executable);

}  // namespace bounce
