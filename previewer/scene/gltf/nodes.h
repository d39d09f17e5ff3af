// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/gltf/accessors.h"
#include "scene/scene.h"

namespace bounce::scene::gltf {

// Fills scene.nodes, roots and topological_order. Refuses cycles, nodes with two parents, and roots
// that have a parent. Needs scene.meshes; leaves Node::light to the light reader.
void read_nodes(Source& source, const Accessors& accessors, Scene& scene);

// Fills scene.skins and checks that the joints of every skinned mesh are in its skin.
void read_skins(Source& source, const Accessors& accessors, Scene& scene);

}  // namespace bounce::scene::gltf
