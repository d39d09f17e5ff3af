// SPDX-License-Identifier: Apache-2.0
//
// Records beside kept pictures. Whoever can write to the folder may have put anything in their place.
#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>

namespace bounce {

// The file's JSON; a discarded value where it is not a regular file (a pipe would be waited for without end),
// cannot be read or is no JSON.
[[nodiscard]] nlohmann::json read_record(const std::filesystem::path& path);

// A member that is a finite number of at least `least`. Throws nlohmann::json::exception where it is anything
// else.
[[nodiscard]] double finite_number(const nlohmann::json& record, const char* name, double least = 0.0);

// A member that is a whole number from `least` to `most`. Throws as above.
[[nodiscard]] int whole_number(const nlohmann::json& record, const char* name, int least, int most);

}  // namespace bounce
