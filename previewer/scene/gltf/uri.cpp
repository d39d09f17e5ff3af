// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/uri.h"

#include <array>
#include <charconv>

#include "scene/gltf/document.h"
#include "scene/gltf/refusal.h"
#include "scene/limits.h"

namespace bounce::scene::gltf {
namespace {

constexpr uint8_t k_not_base64 = 0xFF;

constexpr std::array<uint8_t, 256> base64_values() {
    std::array<uint8_t, 256> values{};
    values.fill(k_not_base64);
    constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < alphabet.size(); ++i) {
        values[static_cast<uint8_t>(alphabet[i])] = static_cast<uint8_t>(i);
    }
    return values;
}

std::vector<uint8_t> base64_decoded(std::string_view text, const std::string& whose) {
    static constexpr std::array<uint8_t, 256> values = base64_values();
    while (!text.empty() && text.back() == '=') {
        text.remove_suffix(1);
    }
    std::vector<uint8_t> bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    uint32_t bits = 0;
    unsigned count = 0;
    for (const char c : text) {
        const uint8_t value = values[static_cast<uint8_t>(c)];
        if (value == k_not_base64) {
            throw refusal("the data URI of {} is not valid base64", whose);
        }
        bits = (bits << 6U) | value;
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes.push_back(static_cast<uint8_t>(bits >> count));
        }
    }
    return bytes;
}

bool has_scheme(std::string_view uri) {
    const size_t colon = uri.find(':');
    return colon != uri.npos && uri.find('/') > colon;
}

}  // namespace

std::string percent_decoded(std::string_view uri) {
    std::string text;
    text.reserve(uri.size());
    for (size_t i = 0; i < uri.size(); ++i) {
        unsigned value = 0;
        if (uri[i] == '%' && i + 2 < uri.size() &&
            std::from_chars(&uri[i + 1], &uri[i] + 3, value, 16).ptr == &uri[i] + 3) {
            text += static_cast<char>(value);
            i += 2;
        } else {
            text += uri[i];
        }
    }
    return text;
}

std::vector<uint8_t> read_uri(const std::string& uri, const std::filesystem::path& folder,
                              const std::string& whose) {
    if (uri.starts_with("data:")) {
        const size_t comma = uri.find(',');
        const std::string_view head = std::string_view(uri).substr(0, comma);
        if (comma == uri.npos || !head.ends_with(";base64")) {
            throw refusal("the data URI of {} is not base64", whose);
        }
        return base64_decoded(std::string_view(uri).substr(comma + 1), whose);
    }
    const std::string name = percent_decoded(uri);
    if (name.empty() || name.find('\0') != name.npos) {
        throw refusal("{} has an empty or broken URI", whose);
    }
    if (has_scheme(uri)) {
        throw refusal("{} lies at {}, and only files beside the scene are read", whose, uri.substr(0, 80));
    }
    try {
        return read_bytes(folder / name, k_max_file_bytes);
    } catch (const Refusal& cause) {
        throw refusal("{} cannot be read: {}", whose, cause.what());
    }
}

}  // namespace bounce::scene::gltf
