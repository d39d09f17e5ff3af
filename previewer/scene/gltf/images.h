// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/gltf/buffers.h"
#include "scene/scene.h"

namespace bounce::scene::gltf {

// Reads and decodes one of the file's images (PNG, JPEG, WebP), wherever it lies. Throws Refusal.
[[nodiscard]] Image read_image(Source& source, Buffers& buffers, int index);

}  // namespace bounce::scene::gltf
