// SPDX-License-Identifier: Apache-2.0
#include "evaluate/scene_files.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <system_error>

#include <nlohmann/json.hpp>

#include "evaluate/cache.h"
#include "evaluate/sha256.h"

namespace bounce {
using nlohmann::literals::operator""_json_pointer;

namespace fs = std::filesystem;
namespace {

// The JSON text of a .gltf, or of a .glb's first chunk: twelve bytes of header, then length, type and text,
// numbers little-endian (glTF 2.0, section 4.4).
std::string json_text(const fs::path& gltf) {
    std::error_code ignored;
    if (!fs::is_regular_file(gltf, ignored)) {
        return {};  // a folder cannot be read, a pipe not twice
    }
    std::ifstream in(gltf, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    constexpr size_t header = 20;
    if (!bytes.starts_with("glTF")) {
        return bytes;
    }
    if (bytes.size() < header) {
        return {};
    }
    size_t length = 0;
    for (size_t i = 0; i < 4; ++i) {
        length |= size_t{static_cast<unsigned char>(bytes[12 + i])} << (8 * i);
    }
    return bytes.substr(header, length);
}

// glTF's URIs escape what file names may hold: "a%20b.png".
std::string decoded(const std::string& uri) {
    std::string name;
    for (size_t i = 0; i < uri.size(); ++i) {
        const auto is_hex = [&](size_t at) {
            return at < uri.size() && std::isxdigit(static_cast<unsigned char>(uri[at])) != 0;
        };
        if (uri[i] == '%' && is_hex(i + 1) && is_hex(i + 2)) {
            name += static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16));
            i += 2;
        } else {
            name += uri[i];
        }
    }
    return name;
}

}  // namespace

std::vector<fs::path> gltf_external_files(const fs::path& gltf) {
    std::vector<fs::path> files;
    const auto json = nlohmann::json::parse(json_text(gltf), nullptr, false);
    if (!json.is_object()) {
        return files;
    }
    for (const char* kind : {"buffers", "images"}) {
        const auto list = json.find(kind);
        if (list == json.end() || !list->is_array()) {
            continue;
        }
        for (const auto& item : *list) {
            if (!item.is_object() || !item.contains("uri") || !item["uri"].is_string()) {
                continue;
            }
            const auto uri = item["uri"].get<std::string>();
            if (!uri.starts_with("data:")) {
                files.push_back(gltf.parent_path() / decoded(uri));
            }
        }
    }
    return files;
}

bool gltf_uses_extension(const fs::path& gltf, std::string_view name) {
    const auto json = nlohmann::json::parse(json_text(gltf), nullptr, false);
    if (!json.is_object() || !json.contains("extensionsUsed") || !json["extensionsUsed"].is_array()) {
        return false;
    }
    return std::any_of(json["extensionsUsed"].begin(), json["extensionsUsed"].end(),
                       [&](const nlohmann::json& used) { return used == name; });
}

std::string sha256_of_gltf(const fs::path& gltf) {
    Sha256 hash;
    hash.add(sha256_of_file(gltf));
    for (const auto& [path, content] : hash_files(gltf_external_files(gltf))) {
        hash.add(path.lexically_relative(gltf.parent_path()).string() + "\n" + content + "\n");
    }
    return hash.hex_digest();
}

bool is_blend(const fs::path& scene) {
    std::string extension = scene.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension == ".blend";
}

bool gltf_names_camera(const fs::path& gltf) {
    const auto json = nlohmann::json::parse(json_text(gltf), nullptr, false);
    return json.is_object() && json.contains("/extensions/BOUNCE_scene/camera"_json_pointer);
}

std::vector<std::string> gltf_not_exported(const fs::path& gltf) {
    std::vector<std::string> lines;
    const auto json = nlohmann::json::parse(json_text(gltf), nullptr, false);
    const auto at = "/extensions/BOUNCE_scene/unsupported"_json_pointer;
    if (!json.is_object() || !json.contains(at) || !json[at].is_array()) {
        return lines;
    }
    for (const auto& item : json[at]) {
        if (item.is_object() && item.contains("object") && item["object"].is_string() &&
            item.contains("what") && item["what"].is_string()) {
            lines.push_back("not exported: " + item["object"].get<std::string>() + ": " +
                            item["what"].get<std::string>());
        }
    }
    return lines;
}

bool is_gltf(const fs::path& gltf) {
    return nlohmann::json::parse(json_text(gltf), nullptr, false).is_object();
}

}  // namespace bounce
