// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/document.h"

#include <algorithm>
#include <fstream>
#include <system_error>

#include "core/json_fault.h"
#include "scene/gltf/refusal.h"
#include "scene/limits.h"

namespace bounce::scene::gltf {
namespace fs = std::filesystem;
namespace {

constexpr uint32_t k_glb_magic = 0x46546C67;   // "glTF"
constexpr uint32_t k_chunk_json = 0x4E4F534A;  // "JSON"
constexpr uint32_t k_chunk_bin = 0x004E4942;   // "BIN"
constexpr size_t k_header_bytes = 12;
constexpr size_t k_chunk_header_bytes = 8;

uint32_t little_endian(std::span<const uint8_t> bytes, size_t at) {
    return static_cast<uint32_t>(bytes[at]) | (static_cast<uint32_t>(bytes[at + 1]) << 8U) |
           (static_cast<uint32_t>(bytes[at + 2]) << 16U) | (static_cast<uint32_t>(bytes[at + 3]) << 24U);
}

// How deep lists and objects stand in each other. The parser's own callback would tell as well, but it
// takes time that grows with the square of a list's length.
int nesting_depth(std::span<const uint8_t> text) {
    int depth = 0;
    int deepest = 0;
    bool in_string = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const auto c = static_cast<char>(text[i]);
        if (in_string) {
            if (c == '\\') {
                ++i;
            } else if (c == '"') {
                in_string = false;
            }
        } else if (c == '"') {
            in_string = true;
        } else if (c == '[' || c == '{') {
            deepest = std::max(deepest, ++depth);
        } else if (c == ']' || c == '}') {
            --depth;
        }
    }
    return deepest;
}

nlohmann::json parse_json(std::span<const uint8_t> text) {
    if (text.size() > k_max_json_bytes) {
        throw refusal("its JSON is {} bytes long, more than the {} allowed", text.size(), k_max_json_bytes);
    }
    // Padding of a sloppy GLB writer; spaces are the parser's own business.
    while (!text.empty() && text.back() == 0) {
        text = text.first(text.size() - 1);
    }
    if (nesting_depth(text) > k_max_json_depth) {
        throw refusal("its JSON nests more than {} levels deep", k_max_json_depth);
    }
    try {
        return nlohmann::json::parse(text.begin(), text.end());
    } catch (const nlohmann::json::exception& error) {
        throw refusal("its JSON cannot be read: {}", json_fault(error));
    }
}

// Returns the JSON chunk and notes the binary chunk, which stands second when there is one.
std::span<const uint8_t> split_glb(Document& document) {
    const std::span<const uint8_t> all(document.bytes);
    if (all.size() < k_header_bytes + k_chunk_header_bytes) {
        throw refusal("it is truncated: {} bytes are too few for a .glb header", all.size());
    }
    const uint32_t version = little_endian(all, 4);
    if (version != 2) {
        throw refusal("it is a binary glTF of version {}; only version 2 is known", version);
    }
    const uint32_t length = little_endian(all, 8);
    if (length > all.size()) {
        throw refusal("it is truncated: its header says {} bytes, but the file has {}", length, all.size());
    }
    const std::span<const uint8_t> body = all.first(std::max<size_t>(length, k_header_bytes));
    std::span<const uint8_t> json;
    size_t at = k_header_bytes;
    for (int chunk = 0; at < body.size(); ++chunk) {
        if (body.size() - at < k_chunk_header_bytes) {
            throw refusal("it is truncated inside the header of chunk {}", chunk);
        }
        const uint32_t chunk_length = little_endian(body, at);
        const uint32_t chunk_type = little_endian(body, at + 4);
        at += k_chunk_header_bytes;
        if (chunk_length > body.size() - at) {
            throw refusal("it is truncated inside chunk {}", chunk);
        }
        if (chunk == 0) {
            if (chunk_type != k_chunk_json) {
                throw refusal("the first chunk of the .glb is not JSON");
            }
            json = body.subspan(at, chunk_length);
        } else if (chunk == 1 && chunk_type == k_chunk_bin) {
            document.binary_chunk = body.subspan(at, chunk_length);
        }
        at += chunk_length;
    }
    if (json.empty()) {
        throw refusal("the .glb has no JSON chunk");
    }
    return json;
}

}  // namespace

std::vector<uint8_t> read_bytes(const fs::path& path, uint64_t most) {
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    if (!fs::exists(status)) {
        throw refusal("{} does not exist", path.string());
    }
    if (!fs::is_regular_file(status)) {
        throw refusal("{} is not a regular file", path.string());
    }
    const uintmax_t size = fs::file_size(path, code);
    if (code) {
        throw refusal("{} cannot be read: {}", path.string(), code.message());
    }
    if (size == 0) {
        throw refusal("{} is empty", path.string());
    }
    if (size > most) {
        throw refusal("{} has {} bytes, more than the {} allowed", path.string(), size, most);
    }
    std::vector<uint8_t> bytes(size);
    std::ifstream in(path, std::ios::binary);
    in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!in) {
        throw refusal("{} cannot be read; check its permissions", path.string());
    }
    return bytes;
}

Document read_document(const fs::path& path) {
    Document document;
    document.folder = path.parent_path();
    document.bytes = read_bytes(path, k_max_file_bytes);
    const bool binary = document.bytes.size() >= 4 && little_endian(document.bytes, 0) == k_glb_magic;
    const std::span<const uint8_t> text =
        binary ? split_glb(document) : std::span<const uint8_t>(document.bytes);
    if (!binary) {
        const std::string_view start(reinterpret_cast<const char*>(text.data()), text.size());
        const size_t first = start.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
        if (first == start.npos || start[first] != '{') {
            throw refusal("it is neither binary glTF nor JSON");
        }
    }
    document.json = parse_json(text);
    if (!document.json.is_object()) {
        throw refusal("its JSON is not an object");
    }
    return document;
}

}  // namespace bounce::scene::gltf
