// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/gltf/accessors.h"

namespace bounce::scene::gltf {

// EXT_mesh_gpu_instancing of a node: node_from_instance, one an instance.
[[nodiscard]] std::vector<glm::dmat4> read_instances(const nlohmann::json& instancing,
                                                     const Accessors& accessors, Source& source, size_t node);

}  // namespace bounce::scene::gltf
