// SPDX-License-Identifier: Apache-2.0
#include "core/json_fault.h"

#include <map>
#include <string_view>

#include <fmt/format.h>

namespace bounce {
namespace {

// The library's numbers of its errors (nlohmann/json, "Exceptions").
enum Id {
    k_syntax = 101,
    k_wrong_type = 302,
    k_no_such_member_type = 304,
    k_not_indexable_type = 305,
    k_no_value_type = 306,
    k_not_utf8 = 316,
    k_index = 401,
    k_no_key = 403,
    k_number_overflow = 406,
    k_ours = 501  // of finite_number() and its like; the library has it for patches, which are not used here
};

// What stands between two words of the text; empty where they are not in it.
std::string_view between(std::string_view text, std::string_view before, std::string_view after) {
    const size_t start = text.find(before);
    if (start == std::string_view::npos) {
        return {};
    }
    text.remove_prefix(start + before.size());
    return text.substr(0, text.find(after));
}

std::string with_article(std::string_view type) {
    static const std::map<std::string_view, const char*> names{
        {"number", "a number"}, {"string", "a text"},         {"object", "an object"},
        {"array", "a list"},    {"boolean", "true or false"}, {"null", "null"}};
    const auto found = names.find(type);
    return found == names.end() ? "another value" : found->second;
}

// Something was looked for in a value of this type.
std::string container_fault(std::string_view type) {
    if (type == "discarded") {  // what parse() gives without exceptions
        return "it is no JSON";
    }
    return fmt::format("{} stands where {} belongs", with_article(type),
                       type == "array"    ? "an object"
                       : type == "object" ? "a list"
                                          : "an object or a list");
}

std::string syntax_fault(std::string_view text) {
    const bool cut = text.find("unexpected end of input") != std::string_view::npos;
    const std::string_view place = between(text, "parse error at ", ":");
    return fmt::format("{}{}{}", cut ? "it breaks off" : "it is no valid JSON", place.empty() ? "" : " at ",
                       place);
}

}  // namespace

std::string json_fault(const nlohmann::json::exception& error) {
    const std::string_view what = error.what();
    const size_t tag = what.find("] ");
    const std::string_view text = tag == std::string_view::npos ? what : what.substr(tag + 2);
    switch (error.id) {
        case k_syntax:
            return syntax_fault(text);
        case k_wrong_type:
            return fmt::format("{} stands where {} belongs", with_article(between(text, "but is ", " ")),
                               with_article(between(text, "must be ", ",")));
        case k_no_such_member_type:
        case k_not_indexable_type:
        case k_no_value_type:
            return container_fault(text.substr(text.rfind(' ') + 1));
        case k_not_utf8:
            return "it has a text that is not UTF-8";
        case k_index:
            return "a list in it is too short";
        case k_no_key:
            return fmt::format("it has no \"{}\"", between(text, "key '", "' not found"));
        case k_number_overflow:
            return fmt::format("the number {} in it is too large", between(text, "parsing '", "'"));
        case k_ours:
            return std::string(text);
        default:
            return "it is not built as it should be";
    }
}

}  // namespace bounce
