// SPDX-License-Identifier: Apache-2.0
#include "evaluate/page.h"

#include <fmt/format.h>

#include "core/error.h"

namespace bounce {

void put_into_page(std::string& page, std::string_view marker, std::string_view text) {
    const size_t at = page.find(marker);
    if (at == std::string::npos) {
        throw Error(ExitCode::failed, fmt::format("the report's template lacks {}", marker));
    }
    page.replace(at, marker.size(), text);
}

std::string json_for_script(const nlohmann::ordered_json& json) {
    std::string text;
    for (const char c : json.dump()) {
        // A scene's name with "</script>" would end the element.
        text += c == '<' ? std::string("\\u003c") : std::string(1, c);
    }
    return text;
}

}  // namespace bounce
