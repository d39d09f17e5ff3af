// SPDX-License-Identifier: Apache-2.0
//
// The vendor extension BOUNCE_scene (docs/bounce_scene.md), except what it adds to cameras and materials.
#pragma once

#include <vector>

#include "scene/gltf/buffers.h"
#include "scene/gltf/source.h"
#include "scene/scene.h"

namespace bounce::scene::gltf {

// The lights of the extension's root object, in its order.
[[nodiscard]] std::vector<Light> read_blender_lights(Source& source);

// Frames, render and view settings, world, active camera, Blender's version and what was not exported;
// or the defaults for a file without the extension. Needs everything else of the scene. A world's image that
// cannot be read is warned of, and the world's colour stands in its place.
void read_scene_settings(Source& source, Buffers& buffers, Scene& scene);

}  // namespace bounce::scene::gltf
