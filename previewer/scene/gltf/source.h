// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

#include "scene/gltf/document.h"
#include "scene/gltf/refusal.h"
#include "scene/limits.h"

namespace bounce::scene::gltf {

// What the file asks of us so far, all primitives and images together (limits.h).
struct Spent {
    uint64_t vertices = 0;
    uint64_t indices = 0;
    uint64_t morph_vertices = 0;
    uint64_t instances = 0;
    uint64_t image_pixels = 0;
    uint64_t animation_values = 0;
};

// One file while it is loaded: its checked JSON, the same as tinygltf's types, and what was said about it.
// Lists of model run parallel to those of the JSON. tinygltf 2.7.0 drops animation channels without a
// node and refuses indices without a buffer view, so animations, images, buffers and extensions are
// read from the JSON.
struct Source {
    Document document;
    tinygltf::Model model;
    std::vector<std::string> warnings;
    Spent spent;

    [[nodiscard]] const nlohmann::json& json() const { return document.json; }
    void warn(std::string sentence);  // once, however often it is said
    // Throws Refusal where amount takes the total over most; what is in the plural ("vertices").
    static void spend(uint64_t& total, uint64_t amount, uint64_t most, std::string_view what);
};

// Reads and checks the file's structure; no buffer or image yet.
[[nodiscard]] Source open_source(const std::filesystem::path& path);

// object.extensions[name], or nullptr.
[[nodiscard]] const nlohmann::json* extension(const nlohmann::json& object, std::string_view name);
// A member or nullptr; never creates.
[[nodiscard]] const nlohmann::json* member(const nlohmann::json& object, std::string_view key);
// The list at key, or an empty one.
[[nodiscard]] const nlohmann::json& list(const nlohmann::json& object, std::string_view key);

// Members of checked type with a default.
[[nodiscard]] float number_or(const nlohmann::json& object, std::string_view key, float otherwise);
[[nodiscard]] std::string string_or(const nlohmann::json& object, std::string_view key,
                                    std::string_view otherwise);
[[nodiscard]] int int_or(const nlohmann::json& object, std::string_view key, int otherwise);

}  // namespace bounce::scene::gltf
