// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "scene/gltf/buffers.h"
#include "scene/scene.h"

namespace bounce::scene::gltf {

// An image's width times height, counted towards what all of the file's images may have. Throws Refusal where
// it is empty, too wide, too high, or too much; `whose` begins the sentence.
[[nodiscard]] uint64_t spend_pixels(Source& source, int width, int height, int channels,
                                    const std::string& whose);

// Reads and decodes one of the file's images (PNG, JPEG, WebP), wherever it lies. Throws Refusal.
[[nodiscard]] Image read_image(Source& source, Buffers& buffers, int index);

}  // namespace bounce::scene::gltf
