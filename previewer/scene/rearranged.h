// SPDX-License-Identifier: Apache-2.0
//
// The same surfaces and lights told in another order or in other meshes: the picture must not change. For
// tests of that, and for `bounce bench invariance`. Each takes a scene and gives it back changed.
#pragma once

#include "scene/scene.h"

namespace bounce::scene {

// Each primitive of at least two triangles becomes two in two meshes: the first half of its triangles stays,
// the others move to a new node below its node. Vertices that both need are doubled.
[[nodiscard]] Scene with_meshes_split(Scene scene);

// Nodes whose meshes stand still and have one user are joined two by two, as Blender's Join does: the
// second's vertices are taken into the first's space, and triangles of one material become one primitive.
// Skinned, morphing, instanced and moving ones stay as they are.
[[nodiscard]] Scene with_meshes_merged(Scene scene);

// Nodes, meshes, their primitives, lights, cameras, materials, textures and images stand in the reverse
// order; children and roots too.
[[nodiscard]] Scene reordered(const Scene& scene);

}  // namespace bounce::scene
