// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/gltf/vertex_attributes.h"
#include "scene/scene.h"

namespace bounce::scene::gltf {

// Fills primitive.joints and primitive.weights: the four largest influences of each vertex, their
// weights summing to one. Left empty where the primitive has none.
void read_influences(Source& source, const VertexAttributes& attributes, Primitive& primitive);

}  // namespace bounce::scene::gltf
