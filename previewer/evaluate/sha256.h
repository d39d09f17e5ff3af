// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace bounce {

// SHA-256 (FIPS 180-4), fed piece by piece. Names what a cached file was made from.
class Sha256 {
  public:
    void add(std::string_view bytes);
    // 64 lower-case hexadecimal digits. The object is not to be used afterwards.
    [[nodiscard]] std::string hex_digest();

  private:
    void add_block(const unsigned char* block);

    std::array<uint32_t, 8> state_{0x6a09e667U, 0xbb67ae85U, 0x3c6ef372U, 0xa54ff53aU,
                                   0x510e527fU, 0x9b05688cU, 0x1f83d9abU, 0x5be0cd19U};
    std::array<unsigned char, 64> pending_{};
    size_t pending_size_ = 0;
    uint64_t total_bytes_ = 0;
};

[[nodiscard]] std::string sha256_of_text(std::string_view text);

// Throws input_error where the file cannot be read.
[[nodiscard]] std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace bounce
