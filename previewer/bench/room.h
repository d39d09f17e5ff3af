// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

namespace bounce::bench {

// A scene for measurements that need none in particular: a closed room 6 m wide with coloured side walls,
// twelve spheres and a free-standing wall, under one spot; with the 64 segments around a sphere that are the
// default, and half as many from pole to pole, 49,176 triangles. segments: an even number; triangles go with
// the square of it.
[[nodiscard]] scene::Scene make_room(int segments = 64);

// Adds a node that has no parent.
void add_root(scene::Scene& scene, scene::Node node);

}  // namespace bounce::bench
