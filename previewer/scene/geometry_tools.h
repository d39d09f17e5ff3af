// SPDX-License-Identifier: Apache-2.0
//
// What the loader does to a primitive so that the renderer finds every stream it needs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace bounce::scene {

// The same primitive with vertices picked from the old ones, in that order: new vertex i is old vertex
// old_vertex[i] in every stream. Indices are left as they are.
[[nodiscard]] Primitive gather_vertices(const Primitive& primitive, std::span<const uint32_t> old_vertex);

// Drops vertices that no triangle uses: files that share one vertex buffer among many primitives would
// otherwise multiply it.
void drop_unused_vertices(Primitive& primitive);

// One normal a face, as glTF asks where a file has none; splits every vertex.
void make_flat_normals(Primitive& primitive);

// Tangents along the gradient of u, made orthogonal to the normals (Lengyel, "Computing Tangent Space
// Basis Vectors for an Arbitrary Mesh", 2001), from uv0 or uv1. Vertices shared by faces with mirrored
// coordinates are split.
void make_tangents(Primitive& primitive, int uv_set);

}  // namespace bounce::scene
