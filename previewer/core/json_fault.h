// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace bounce {

// What is wrong with a JSON text or with what it holds, for people: "it has no \"width\"", "it breaks off at
// line 3, column 7". Of the library's own text only the place stays.
[[nodiscard]] std::string json_fault(const nlohmann::json::exception& error);

}  // namespace bounce
