// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <system_error>

namespace bounce {

// No error where the folder takes a file of so many bytes now, else the system's ("No space left on device").
// To be asked where another program writes, which may not say, or not know, why it failed.
[[nodiscard]] std::error_code check_room(const std::filesystem::path& folder, size_t bytes);

}  // namespace bounce
