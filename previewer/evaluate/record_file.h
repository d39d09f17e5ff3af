// SPDX-License-Identifier: Apache-2.0
//
// JSON that is read back: records beside kept pictures, baselines, tuning files. Whoever can write to the
// folder may have put anything in their place. What throws here throws nlohmann::json::exception, which
// json_fault() puts into words.
#pragma once

#include <filesystem>
#include <string>
#include <type_traits>
#include <vector>

#include <nlohmann/json.hpp>

namespace bounce {

// The file's JSON; a discarded value where it is not a regular file (a pipe would be waited for without end),
// cannot be read or is no JSON.
[[nodiscard]] nlohmann::json read_record(const std::filesystem::path& path);

// A member that is a finite number of at least `least`.
[[nodiscard]] double finite_number(const nlohmann::json& record, const char* name, double least = 0.0);

// A member that is a whole number between the two.
[[nodiscard]] int whole_number(const nlohmann::json& record, const char* name, int least, int most);

// A member that is a list.
[[nodiscard]] const nlohmann::json& list_member(const nlohmann::json& record, const char* name);

// Throws "NAME is VALUE, not WANTED" of a member that is there.
[[noreturn]] void throw_wrong(const nlohmann::json& record, const char* name, const std::string& wanted);

// A member as a number, a text or a list of either.
template <typename T>
[[nodiscard]] T member(const nlohmann::json& record, const char* name) {
    const nlohmann::json& value = record.at(name);
    try {
        return value.get<T>();
    } catch (const nlohmann::json::type_error&) {
        throw_wrong(record, name,
                    std::is_arithmetic_v<T>                       ? "a number"
                    : std::is_same_v<T, std::string>              ? "a text"
                    : std::is_same_v<T, std::vector<std::string>> ? "a list of texts"
                                                                  : "a list of numbers");
    }
}

}  // namespace bounce
