// SPDX-License-Identifier: Apache-2.0
//
// Names for contents, so that what was made of the same things need not be made again.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace bounce {

// Stands for contents: two that are equal are of the same bytes, but for a chance of 2^-128. All zeros:
// unknown.
struct ContentKey {
    uint64_t low = 0;
    uint64_t high = 0;
    [[nodiscard]] bool known() const { return low != 0 || high != 0; }
    friend auto operator<=>(const ContentKey&, const ContentKey&) = default;
};

// Gathers what decides on contents; values of the same bytes in the same order have the same key.
class ContentHash {
  public:
    // Types without padding: numbers, enums, and structs of them laid out for shaders.
    template <typename T>
    requires(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>) ContentHash& add(const T& value) {
        return add_bytes(std::as_bytes(std::span(&value, 1)));
    }
    template <typename T>
    ContentHash& add_all(std::span<const T> values) {
        add(values.size());
        return add_bytes(std::as_bytes(values));
    }
    ContentHash& add_text(std::string_view text) { return add_all(std::span<const char>(text)); }
    ContentHash& add_bytes(std::span<const std::byte> bytes);

    // Of all that was added; never unknown. XXH3, 128 bits.
    [[nodiscard]] ContentKey key() const;

  private:
    std::vector<std::byte> bytes_;
};

}  // namespace bounce
