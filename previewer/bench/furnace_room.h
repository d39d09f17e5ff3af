// SPDX-License-Identifier: Apache-2.0
//
// Closed empty rooms whose light is known: every wall is one diffuse white, and what one sends the others get.
#pragma once

#include <vector>

#include "renderer/camera_view.h"
#include "renderer/settings.h"
#include "scene/scene.h"

namespace bounce::bench {

enum class FurnaceShape { cube, sphere };
enum class FurnaceLight {
    emission,  // of all walls alike: radiance k_furnace_emission
    point,     // one point light of k_furnace_power_w, beside the middle
};
constexpr double k_furnace_emission = 1.0;
constexpr double k_furnace_power_w = 100.0;

struct Furnace {
    FurnaceShape shape = FurnaceShape::cube;
    FurnaceLight light = FurnaceLight::emission;
    float albedo = 0.5F;
};

// A cube of 2 m, or a sphere of 2 m across in 96 x 48 quadrilaterals, around the origin.
[[nodiscard]] scene::Scene make_furnace(const Furnace& furnace);

// Six views from the middle, which together see every wall once: a cube's all of its pixels. Their means over
// all pixels have one mean over the walls where a wall's own is even, as in a sphere, or where each view is a
// wall, as in a cube.
[[nodiscard]] std::vector<CameraView> furnace_cameras(FurnaceShape shape);

// The mean radiance of the walls after so many bounces of light. An emission E is itself a wall's, and shines
// on walls before any bounce: E (1 + r + ... + r^(bounces + 1)) with the albedo r, the same everywhere in any
// closed room. A light's power P falls on walls of area A: r / pi * P / A * (1 + r + ... + r^bounces) in the
// mean; in a sphere the same everywhere but for the light's own.
[[nodiscard]] double furnace_radiance(const Furnace& furnace, int bounces);

}  // namespace bounce::bench
