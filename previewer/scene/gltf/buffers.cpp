// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/buffers.h"

#include "scene/gltf/meshopt_decoder.h"
#include "scene/gltf/uri.h"

namespace bounce::scene::gltf {

Buffers::Buffers(const Source& source)
    : source_(source),
      storage_(list(source.json(), "buffers").size()),
      buffers_(storage_.size()),
      decoded_views_(source.model.bufferViews.size()) {}

std::span<const uint8_t> Buffers::buffer(int index) {
    const auto at = static_cast<size_t>(index);
    if (!buffers_[at].empty()) {
        return buffers_[at];
    }
    const nlohmann::json& description = source_.json()["buffers"][at];
    const auto length = description["byteLength"].get<uint64_t>();
    std::span<const uint8_t> bytes;
    if (const nlohmann::json* uri = member(description, "uri")) {
        storage_[at] = read_uri(uri->get_ref<const std::string&>(), source_.document.folder,
                                fmt::format("buffer {}", index));
        bytes = storage_[at];
    } else if (index == 0 && !source_.document.binary_chunk.empty()) {
        bytes = source_.document.binary_chunk;
    } else {
        throw refusal("buffer {} has neither a URI nor a binary chunk", index);
    }
    if (bytes.size() < length) {
        throw refusal("buffer {} is truncated: it has {} of its {} bytes", index, bytes.size(), length);
    }
    buffers_[at] = bytes.first(length);
    return buffers_[at];
}

std::span<const uint8_t> Buffers::slice(int buffer_index, uint64_t offset, uint64_t length,
                                        const std::string& whose) {
    const std::span<const uint8_t> bytes = buffer(buffer_index);
    if (offset > bytes.size() || length > bytes.size() - offset) {
        throw refusal("{} reads past the end of buffer {}", whose, buffer_index);
    }
    return bytes.subspan(offset, length);
}

std::span<const uint8_t> Buffers::view(int index) {
    const auto at = static_cast<size_t>(index);
    if (!decoded_views_[at].empty()) {
        return decoded_views_[at];
    }
    const tinygltf::BufferView& typed = source_.model.bufferViews[at];
    const std::string whose = fmt::format("buffer view {}", index);
    if (const nlohmann::json* packed =
            extension(source_.json()["bufferViews"][at], "EXT_meshopt_compression")) {
        const std::span<const uint8_t> bytes =
            slice((*packed)["buffer"].get<int>(),
                  member(*packed, "byteOffset") == nullptr ? 0 : (*packed)["byteOffset"].get<uint64_t>(),
                  (*packed)["byteLength"].get<uint64_t>(), whose);
        decoded_views_[at] = decode_meshopt(*packed, bytes, whose);
        if (decoded_views_[at].size() < typed.byteLength) {
            throw refusal("{} decompresses to {} of its {} bytes", whose, decoded_views_[at].size(),
                          typed.byteLength);
        }
        return decoded_views_[at];
    }
    return slice(typed.buffer, typed.byteOffset, typed.byteLength, whose);
}

}  // namespace bounce::scene::gltf
