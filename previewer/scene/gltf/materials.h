// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/gltf/textures.h"
#include "scene/scene.h"

namespace bounce::scene::gltf {

// Every material of the file, in its order; fills scene.textures and scene.images with what they use.
void read_materials(Source& source, Buffers& buffers, Scene& scene);

}  // namespace bounce::scene::gltf
