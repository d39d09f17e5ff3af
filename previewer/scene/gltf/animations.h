// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/gltf/accessors.h"
#include "scene/scene.h"

namespace bounce::scene::gltf {

// Fills scene.animations. Needs everything that can be animated; khr_lights is read_lights' result.
void read_animations(Source& source, const Accessors& accessors, const std::vector<int>& khr_lights,
                     Scene& scene);

}  // namespace bounce::scene::gltf
