// SPDX-License-Identifier: Apache-2.0
#include "core/content_key.h"

#include <xxhash.h>

namespace bounce {

ContentHash& ContentHash::add_bytes(std::span<const std::byte> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return *this;
}

ContentKey ContentHash::key() const {
    const XXH128_hash_t hash = XXH3_128bits(bytes_.data(), bytes_.size());
    return {hash.low64 | 1U, hash.high64};
}

}  // namespace bounce
