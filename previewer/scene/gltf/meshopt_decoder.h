// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace bounce::scene::gltf {

// EXT_meshopt_compression's description of a buffer view, and its compressed bytes. Throws Refusal.
[[nodiscard]] std::vector<uint8_t> decode_meshopt(const nlohmann::json& description,
                                                  std::span<const uint8_t> bytes, const std::string& whose);

}  // namespace bounce::scene::gltf
