// SPDX-License-Identifier: Apache-2.0
//
// Which surfaces let a part of the light through, as Cycles' mix with a Transparent BSDF does.
#pragma once

#include "scene/pose.h"
#include "scene/scene.h"

namespace bounce::scene {

// Below the first a fragment is not there, from the second on it is opaque: two steps of an 8-bit alpha are
// 1/255, and what lies within half of one of either end is that end.
constexpr float k_alpha_nothing = 1.0F / 512.0F;
constexpr float k_alpha_solid = 511.0F / 512.0F;

// What a blended material's alpha can be over a primitive.
struct Coverage {
    bool visible = true;   // it is not 0 everywhere
    bool blended = false;  // it may lie between 0 and 1
    bool solid = true;     // it may be 1
};

// material: the pose's. One that is not blended is visible and solid, whatever an alpha test cuts from it.
[[nodiscard]] Coverage coverage(const Scene& scene, const Material& material, const Primitive& primitive);

// Whether anything that the pose draws is blended.
[[nodiscard]] bool draws_blended(const Scene& scene, const Pose& pose);

}  // namespace bounce::scene
