// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include <nlohmann/json.hpp>

namespace bounce::scene::gltf {

// A .glb or .gltf file taken apart, nothing of its content trusted yet.
struct Document {
    std::filesystem::path folder;  // relative URIs start here
    nlohmann::json json;
    std::vector<uint8_t> bytes;             // the whole file
    std::span<const uint8_t> binary_chunk;  // of a .glb, inside bytes; empty otherwise
};

[[nodiscard]] Document read_document(const std::filesystem::path& path);

// The whole file; throws Refusal where it is missing, not a regular file, empty or longer than most bytes.
[[nodiscard]] std::vector<uint8_t> read_bytes(const std::filesystem::path& path, uint64_t most);

}  // namespace bounce::scene::gltf
