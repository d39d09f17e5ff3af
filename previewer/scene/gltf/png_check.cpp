// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/png_check.h"

#include <array>

namespace bounce::scene::gltf {
namespace {

constexpr size_t k_signature_bytes = 8;
constexpr size_t k_around_chunk = 12;   // length, type and checksum
constexpr uint32_t k_end = 0x49454E44;  // "IEND"

// CRC-32 as in ISO 3309, reflected polynomial (PNG specification, annex D).
constexpr std::array<uint32_t, 256> crc_table() {
    std::array<uint32_t, 256> table{};
    for (uint32_t i = 0; i < table.size(); ++i) {
        uint32_t value = i;
        for (int bit = 0; bit < 8; ++bit) {
            value = (value & 1U) != 0 ? 0xEDB88320U ^ (value >> 1U) : value >> 1U;
        }
        table[i] = value;
    }
    return table;
}

uint32_t crc_of(std::span<const uint8_t> bytes) {
    static constexpr std::array<uint32_t, 256> table = crc_table();
    uint32_t crc = 0xFFFFFFFFU;
    for (const uint8_t byte : bytes) {
        crc = table[(crc ^ byte) & 0xFFU] ^ (crc >> 8U);
    }
    return ~crc;
}

uint32_t big_endian(std::span<const uint8_t> bytes, size_t at) {
    return (static_cast<uint32_t>(bytes[at]) << 24U) | (static_cast<uint32_t>(bytes[at + 1]) << 16U) |
           (static_cast<uint32_t>(bytes[at + 2]) << 8U) | static_cast<uint32_t>(bytes[at + 3]);
}

}  // namespace

bool is_whole_png(std::span<const uint8_t> bytes) {
    size_t at = k_signature_bytes;
    while (at < bytes.size() && bytes.size() - at >= k_around_chunk) {
        const size_t length = big_endian(bytes, at);
        if (length > bytes.size() - at - k_around_chunk) {
            return false;
        }
        if (crc_of(bytes.subspan(at + 4, length + 4)) != big_endian(bytes, at + 8 + length)) {
            return false;
        }
        if (big_endian(bytes, at + 4) == k_end) {
            return true;
        }
        at += k_around_chunk + length;
    }
    return false;
}

}  // namespace bounce::scene::gltf
