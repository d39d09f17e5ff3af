// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

namespace bounce::scene::gltf {

// True where a PNG's chunks are whole: signature, lengths, checksums and the end are there. The decoder
// writes its own complaints about damaged files to stderr, so they are found before it sees them.
[[nodiscard]] bool is_whole_png(std::span<const uint8_t> bytes);

}  // namespace bounce::scene::gltf
