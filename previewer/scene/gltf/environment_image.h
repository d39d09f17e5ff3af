// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "scene/gltf/buffers.h"
#include "scene/scene.h"

namespace bounce::scene::gltf {

// The image that `description` (extensions.BOUNCE_scene.world.image) names: OpenEXR or Radiance HDR, in the
// file or beside it, scene-linear. Texels that are negative or not finite become 0, with a warning that
// counts them. None, with a warning that names the image and says why, where it cannot be read.
[[nodiscard]] std::optional<Environment> read_environment(Source& source, Buffers& buffers,
                                                          const nlohmann::json& description);

}  // namespace bounce::scene::gltf
