// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/gltf/source.h"
#include "scene/scene.h"

namespace bounce::scene::gltf {

// Every camera of the file, with Blender's sensor where BOUNCE_scene has it.
void read_cameras(const Source& source, Scene& scene);

}  // namespace bounce::scene::gltf
