// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace bounce::scene::gltf {

// "%20" to a space; a percent sign without two hex digits stands for itself.
[[nodiscard]] std::string percent_decoded(std::string_view uri);

// The bytes behind a URI: base64 data in the URI itself, or a file relative to folder. Throws Refusal;
// whose ("buffer 0") says what wanted it.
[[nodiscard]] std::vector<uint8_t> read_uri(const std::string& uri, const std::filesystem::path& folder,
                                            const std::string& whose);

}  // namespace bounce::scene::gltf
