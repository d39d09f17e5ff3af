// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "core/error.h"

namespace bounce {

// The error to report where a folder for temporary files takes no picture more of that size; nothing where it
// does. Blender's own words for a full disk are many, and a picture that it had to cut off is a success to
// it.
[[nodiscard]] std::optional<Error> no_room_for_picture(const std::filesystem::path& folder, int width,
                                                       int height);

}  // namespace bounce
