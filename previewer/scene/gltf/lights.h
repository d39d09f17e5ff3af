// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/gltf/source.h"
#include "scene/scene.h"

namespace bounce::scene::gltf {

// Luminous efficacy that KHR_lights_punctual's writers use (Blender's "Standard" unit): candela and lux
// divided by it are W/sr and W/m^2.
constexpr float k_lumens_per_watt = 683.0F;
constexpr float k_watts_per_candela = 4.0F * 3.14159265F / k_lumens_per_watt;
constexpr float k_irradiance_per_lux = 1.0F / k_lumens_per_watt;

// Fills scene.lights: those of BOUNCE_scene in its order, then those of KHR_lights_punctual that a node
// without a BOUNCE_scene light uses; and Node::light. Returns, for each KHR light, its index in
// scene.lights or k_none.
std::vector<int> read_lights(Source& source, Scene& scene);

}  // namespace bounce::scene::gltf
