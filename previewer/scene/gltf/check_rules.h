// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace bounce::scene::gltf {

enum class Kind {
    list,  // at most k_max_list_items long
    object,
    string,
    boolean,
    integer,   // low to high
    number,    // low to high, finite
    numbers,   // a list of `low` finite numbers, any length where low is 0
    index,     // into the list at `target`
    required,  // an object that has the property `target`
};

struct Rule {
    std::string_view pattern;
    Kind kind{};
    double low = 0.0;
    double high = 0.0;
    std::string_view target{};
};

// In the order they must be checked: containers before what they hold.
[[nodiscard]] std::span<const Rule> structure_rules();

}  // namespace bounce::scene::gltf
