// SPDX-License-Identifier: Apache-2.0
#include "evaluate/record_file.h"

#include <cmath>
#include <fstream>
#include <string>
#include <system_error>

#include <fmt/format.h>

namespace bounce {
namespace {

using nlohmann::json;

// As the library's own for a wrong type, so that a reader has one kind of exception to catch.
[[noreturn]] void throw_wrong(const json& record, const char* name, const std::string& wanted) {
    throw json::other_error::create(
        501, fmt::format("{} is {}, not {}", name, record.at(name).dump(), wanted), &record);
}

}  // namespace

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
