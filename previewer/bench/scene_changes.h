// SPDX-License-Identifier: Apache-2.0
//
// Changes of a scene that must not change its picture, and how much they do.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "image/image.h"
#include "scene/scene.h"

namespace bounce::bench {

// How far a picture may be from that of the unchanged scene; the reasons are in docs/invariance.md.
enum class Allowed {
    nothing,   // every number the program computes with is the same: so is every bit of the picture
    halves,    // floats round elsewhere, and few of them to another half
    rounding,  // vertices round elsewhere; lights that are drawn from points anew differ as other seeds do
    sampling,  // lights, points and texels of maps lie elsewhere
};

struct SceneChange {
    std::string name;
    std::function<scene::Scene(const scene::Scene&)> apply;
    double light = 1.0;  // what the picture is multiplied by
    Allowed allowed = Allowed::rounding;
};
[[nodiscard]] const std::vector<SceneChange>& scene_changes();

// Throws usage_error, which lists the names there are.
[[nodiscard]] const SceneChange& scene_change(const std::string& name);

struct Difference {
    double worst = 0.0;    // largest |a - b| / (|b| + a hundredth of the mean of b), over pixels and channels
    double changed = 0.0;  // share of pixels where that is above k_visible
    double relmse = 0.0;   // relmse_exposed, image/metrics.h
    double bias = 0.0;     // mean(a) / mean(b) - 1
    size_t not_finite = 0;
};
constexpr double k_visible = 1e-3;

// test, divided by `light`, against reference. Throws input_error where the sizes differ.
[[nodiscard]] Difference difference(const Image& test, const Image& reference, double light = 1.0);

// The largest relMSE that a change may make, where pictures that differ in nothing but their seed are
// `own_error` apart. redrawn: lights are drawn from points that those of the bounce before light.
[[nodiscard]] double relmse_bound(Allowed allowed, double own_error, bool redrawn);

// Whether the difference is within what is allowed: its relMSE within the bound, no pixel changed where
// nothing may, by more than two steps of a half where those may, and all numbers finite.
[[nodiscard]] bool holds(const Difference& difference, Allowed allowed, double own_error, bool redrawn);

}  // namespace bounce::bench
