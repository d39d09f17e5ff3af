// SPDX-License-Identifier: Apache-2.0
#include "core/disk_room.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <string>

#include <fcntl.h>
#include <unistd.h>

namespace bounce {

std::error_code check_room(const std::filesystem::path& folder, size_t bytes) {
    std::string name = (folder / "room-XXXXXX").string();
    const int file = mkstemp(name.data());
    if (file < 0) {
        return {errno, std::generic_category()};
    }
    unlink(name.c_str());
    // Allocated rather than asked for: quotas and limits of a file's size count as well.
    const int code = posix_fallocate(file, 0, static_cast<off_t>(std::max<size_t>(bytes, 1)));
    close(file);
    return {code, std::generic_category()};
}

}  // namespace bounce
