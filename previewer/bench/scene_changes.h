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
    rounding,  // floats round elsewhere: pixels on edges flip, hardly any other changes
    sampling,  // lights and points are chosen anew: as far as pictures with other seeds are from each other
};

struct SceneChange {
    std::string name;
    std::function<scene::Scene(const scene::Scene&)> apply;
    double light = 1.0;  // what the picture is multiplied by
    Allowed allowed = Allowed::rounding;
};
[[nodiscard]] const std::vector<SceneChange>& scene_changes();

// Throws std::out_of_range for an unknown name.
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

// The largest relMSE that the change may have, where pictures that differ in nothing but their seed are
// `own_error` apart.
[[nodiscard]] double relmse_bound(Allowed allowed, double own_error);

}  // namespace bounce::bench
