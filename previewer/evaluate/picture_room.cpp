// SPDX-License-Identifier: Apache-2.0
#include "evaluate/picture_room.h"

#include <system_error>

#include <fmt/format.h>

#include "core/disk_room.h"

namespace bounce {

std::optional<Error> no_room_for_picture(const std::filesystem::path& folder, int width, int height) {
    // Three floats a pixel, and a header.
    const size_t bytes = static_cast<size_t>(width) * static_cast<size_t>(height) * 12U + (size_t{1} << 16U);
    const std::error_code code = check_room(folder, bytes);
    if (!code) {
        return std::nullopt;
    }
    return output_error(fmt::format(
        "there is no room for temporary files in {}: {}; make some, or set TMPDIR to another folder",
        folder.parent_path().string(), code.message()));
}

}  // namespace bounce
