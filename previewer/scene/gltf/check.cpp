// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/check.h"

#include <cmath>
#include <functional>
#include <span>
#include <string_view>

#include "scene/gltf/check_rules.h"
#include "scene/gltf/refusal.h"
#include "scene/limits.h"

namespace bounce::scene::gltf {
namespace {

using nlohmann::json;
using Visit = std::function<void(json& value, const std::string& where)>;

// Calls visit for everything in value that the pattern names: keys joined by '/', '*' for every item of
// a list or object. What is absent, or not of a kind that has items, is passed over: another rule
// answers for its type. Patterns are our own, so the recursion is as deep as the longest of them.
void for_each_match(json& value, std::string_view pattern, const std::string& where, const Visit& visit) {
    const size_t slash = pattern.find('/');
    const std::string_view head = pattern.substr(0, slash);
    const auto descend = [&](json& child, const std::string& child_where) {
        if (slash == pattern.npos) {
            visit(child, child_where);
        } else {
            for_each_match(child, pattern.substr(slash + 1), child_where, visit);
        }
    };
    if (head == "*" && value.is_array()) {
        for (size_t i = 0; i < value.size(); ++i) {
            descend(value[i], fmt::format("{}/{}", where, i));
        }
    } else if (head == "*" && value.is_object()) {
        for (auto& [key, child] : value.items()) {
            descend(child, fmt::format("{}/{}", where, key));
        }
    } else if (head != "*" && value.is_object()) {
        if (const auto found = value.find(head); found != value.end()) {
            descend(*found, where.empty() ? std::string(head) : fmt::format("{}/{}", where, head));
        }
    }
}

size_t list_size(json& root, std::string_view path) {
    size_t size = 0;
    for_each_match(root, path, "", [&](json& list, const std::string&) { size = list.size(); });
    return size;
}

void check_integer(json& value, const std::string& where) {
    if (value.is_number_float()) {
        const auto number = value.get<double>();
        // 2^53: beyond it a double no longer names one integer.
        if (number == std::floor(number) && std::abs(number) < 9007199254740992.0) {
            value = static_cast<int64_t>(number);
        }
    }
    if (!value.is_number_integer()) {
        throw refusal("{} is not an integer", where);
    }
}

void check_range(json& value, const std::string& where, const Rule& rule) {
    // Unsigned values above 2^63 become doubles here, which is near enough to refuse them.
    const auto number = value.get<double>();
    if (!std::isfinite(number)) {
        throw refusal("{} is not finite", where);
    }
    if (number < rule.low || number > rule.high) {
        throw refusal("{} is {}, outside {} to {}", where, value.dump(), rule.low, rule.high);
    }
}

void check_numbers(const json& value, const std::string& where, size_t count) {
    if (!value.is_array() || (count != 0 && value.size() != count)) {
        throw refusal("{} is not a list of {} numbers", where, count);
    }
    for (const json& item : value) {
        if (!item.is_number() || !std::isfinite(item.get<float>())) {
            throw refusal("{} holds something that is not a finite number", where);
        }
    }
}

void check_rule(json& root, const Rule& rule) {
    const size_t target_size = rule.kind == Kind::index ? list_size(root, rule.target) : 0;
    for_each_match(root, rule.pattern, "", [&](json& value, const std::string& where) {
        switch (rule.kind) {
            case Kind::list:
                if (!value.is_array()) {
                    throw refusal("{} is not a list", where);
                }
                if (value.size() > k_max_list_items) {
                    throw refusal("{} has {} items, more than the {} allowed", where, value.size(),
                                  k_max_list_items);
                }
                break;
            case Kind::object:
                if (!value.is_object()) {
                    throw refusal("{} is not an object", where);
                }
                break;
            case Kind::string:
                if (!value.is_string()) {
                    throw refusal("{} is not a string", where);
                }
                break;
            case Kind::boolean:
                if (!value.is_boolean()) {
                    throw refusal("{} is neither true nor false", where);
                }
                break;
            case Kind::integer:
                check_integer(value, where);
                check_range(value, where, rule);
                break;
            case Kind::number:
                if (!value.is_number()) {
                    throw refusal("{} is not a number", where);
                }
                check_range(value, where, rule);
                break;
            case Kind::numbers:
                check_numbers(value, where, static_cast<size_t>(rule.low));
                break;
            case Kind::index:
                check_integer(value, where);
                if (value.get<double>() < 0 || value.get<double>() >= static_cast<double>(target_size)) {
                    throw refusal("{} refers to {} {}, and there are {}", where, rule.target, value.dump(),
                                  target_size);
                }
                break;
            case Kind::required:
                if (!value.is_object() || !value.contains(rule.target)) {
                    throw refusal("{} has no {}", where.empty() ? "the file" : where, rule.target);
                }
                break;
        }
    });
}

void check_version(const json& root) {
    const auto asset = root.find("asset");
    if (asset == root.end() || !asset->is_object() || !asset->contains("version")) {
        throw refusal("it has no asset.version, so it is not glTF 2.0");
    }
    const json& version = (*asset)["version"];
    if (!version.is_string() || !version.get<std::string>().starts_with("2.")) {
        throw refusal("it is glTF of version {}; only 2.x is known", version.dump());
    }
    if (const auto least = asset->find("minVersion"); least != asset->end() && *least != "2.0") {
        throw refusal("it needs glTF {} at least; 2.0 is known", least->dump());
    }
}

}  // namespace

void check_structure(json& root) {
    check_version(root);
    for (const Rule& rule : structure_rules()) {
        check_rule(root, rule);
    }
}

}  // namespace bounce::scene::gltf
