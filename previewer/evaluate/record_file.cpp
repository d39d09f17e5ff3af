// SPDX-License-Identifier: Apache-2.0
#include "evaluate/record_file.h"

#include <cmath>
#include <fstream>
#include <string>
#include <system_error>

#include <fmt/format.h>

namespace bounce {
namespace {

constexpr size_t k_most_shown = 40;  // characters of a value in a message

}  // namespace

using nlohmann::json;

// As the library's own for a wrong type, so that a reader has one kind of exception to catch.
void throw_wrong(const json& record, const char* name, const std::string& wanted) {
    std::string value = record.at(name).dump(-1, ' ', true);  // ASCII: cut anywhere
    if (value.size() > k_most_shown) {
        value = value.substr(0, k_most_shown) + "...";
    }
    throw json::other_error::create(501, fmt::format("{} is {}, not {}", name, value, wanted), &record);
}

const json& list_member(const json& record, const char* name) {
    const json& list = record.at(name);
    if (!list.is_array()) {
        throw_wrong(record, name, "a list");
    }
    return list;
}

json read_record(const std::filesystem::path& path) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) {
        return json(json::value_t::discarded);
    }
    std::ifstream in(path);
    return json::parse(in, nullptr, false);
}

double finite_number(const json& record, const char* name, double least) {
    const json& member = record.at(name);
    if (!member.is_number() || !std::isfinite(member.get<double>()) || member.get<double>() < least) {
        throw_wrong(record, name, fmt::format("a number of at least {}", least));
    }
    return member.get<double>();
}

int whole_number(const json& record, const char* name, int least, int most) {
    const json& member = record.at(name);
    // Through double: a number that int cannot hold is not between the limits either.
    const double value = member.is_number_integer() ? member.get<double>() : std::nan("");
    if (!(value >= least && value <= most)) {
        throw_wrong(record, name, fmt::format("a whole number from {} to {}", least, most));
    }
    return static_cast<int>(value);
}

}  // namespace bounce
