// SPDX-License-Identifier: Apache-2.0
//
// Pages made of a template that the build packs into the program (embedded.h) and of data.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace bounce {

// Replaces the first place where marker stands. Throws Error (failed) where our own template lacks it.
void put_into_page(std::string& page, std::string_view marker, std::string_view text);

// JSON to stand inside a <script> element.
[[nodiscard]] std::string json_for_script(const nlohmann::ordered_json& json);

}  // namespace bounce
