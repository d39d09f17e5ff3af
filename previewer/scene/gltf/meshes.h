// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/gltf/accessors.h"
#include "scene/scene.h"

namespace bounce::scene::gltf {

// Every mesh as triangle lists, in the file's order. materials decide which primitives need tangents.
[[nodiscard]] std::vector<Mesh> read_meshes(Source& source, Buffers& buffers, const Accessors& accessors,
                                            const std::vector<Material>& materials);

}  // namespace bounce::scene::gltf
