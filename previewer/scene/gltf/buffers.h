// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/gltf/source.h"

namespace bounce::scene::gltf {

// The bytes of a file's buffers. A buffer is read when a view into it is first asked for, so what
// nothing uses (a meshopt fallback, say) is neither needed nor missed.
class Buffers {
  public:
    explicit Buffers(const Source& source);

    // The bytes of a buffer view, decompressed where EXT_meshopt_compression holds them. The span
    // lives as long as this object. Throws Refusal where the view does not fit in its buffer.
    [[nodiscard]] std::span<const uint8_t> view(int index);

  private:
    [[nodiscard]] std::span<const uint8_t> buffer(int index);
    [[nodiscard]] std::span<const uint8_t> slice(int buffer_index, uint64_t offset, uint64_t length,
                                                 const std::string& whose);

    const Source& source_;
    std::vector<std::vector<uint8_t>> storage_;        // per buffer; unused by a .glb's own chunk
    std::vector<std::span<const uint8_t>> buffers_;    // empty until read
    std::vector<std::vector<uint8_t>> decoded_views_;  // per view; empty where not compressed
};

}  // namespace bounce::scene::gltf
