// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

namespace bounce::scene {

// The boxes of a primitive's vertices: all of them, and those that each joint moves.
[[nodiscard]] PrimitiveBounds primitive_bounds(const Primitive& primitive);

}  // namespace bounce::scene
