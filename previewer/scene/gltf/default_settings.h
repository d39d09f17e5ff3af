// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

namespace bounce::scene::gltf {

// Frames, world and camera of a file that says nothing about them (any glTF in the world). Needs nodes,
// materials, lights and animations.
void set_default_settings(Scene& scene);

}  // namespace bounce::scene::gltf
