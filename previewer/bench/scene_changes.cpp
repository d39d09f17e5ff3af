// SPDX-License-Identifier: Apache-2.0
#include "bench/scene_changes.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.h"
#include "image/metrics.h"
#include "scene/rearranged.h"
#include "scene/transformed.h"

namespace bounce::bench {
namespace {

SceneChange scaling(const char* name, double factor, Allowed allowed = Allowed::rounding) {
    return {name, [factor](const scene::Scene& scene) { return scene::scaled(scene, factor); }, 1.0, allowed};
}

SceneChange lighting(const char* name, double factor) {
    return {name, [factor](const scene::Scene& scene) { return scene::relit(scene, factor); }, factor,
            Allowed::halves};
}

SceneChange turning(const char* name, double degrees, const glm::dvec3& axis, Allowed allowed) {
    return {name,
            [degrees, axis](const scene::Scene& scene) {
                return scene::turned(scene, glm::angleAxis(glm::radians(degrees), glm::normalize(axis)));
            },
            1.0, allowed};
}

}  // namespace

const std::vector<SceneChange>& scene_changes() {
    static const std::vector<SceneChange> all = {
        scaling("scale 1e-3", 1e-3),
        scaling("scale 1e3", 1e3),
        scaling("scale 1e5", 1e5),
        scaling("scale 2^20", 0x1p20, Allowed::nothing),
        {"move 1e6",
         [](const scene::Scene& scene) {
             return scene::moved(scene, {1e6, -1e6, 1e6});
         },
         1.0, Allowed::rounding},
        lighting("light 1e-6", 1e-6),
        lighting("light 1e6", 1e6),
        turning("turn 90, up", 90.0, {0.0, 1.0, 0.0}, Allowed::sampling),
        turning("turn 37, up", 37.0, {0.0, 1.0, 0.0}, Allowed::sampling),
        turning("turn 50, slanted", 50.0, {1.0, 2.0, -3.0}, Allowed::sampling),
        {"split meshes", [](const scene::Scene& scene) { return scene::with_meshes_split(scene); }, 1.0,
         Allowed::sampling},
        {"merge meshes", [](const scene::Scene& scene) { return scene::with_meshes_merged(scene); }, 1.0,
         Allowed::sampling},
        {"reorder", [](const scene::Scene& scene) { return scene::reordered(scene); }, 1.0,
         Allowed::rounding},
    };
    return all;
}

const SceneChange& scene_change(const std::string& name) {
    std::string known;
    for (const SceneChange& change : scene_changes()) {
        if (change.name == name) {
            return change;
        }
        known += fmt::format("{}'{}'", known.empty() ? "" : ", ", change.name);
    }
    throw usage_error(fmt::format("there is no change '{}'; there are {}", name, known));
}

Difference difference(const Image& test, const Image& reference, double light) {
    Image scaled = test;
    for (float& value : scaled.rgb) {
        value = static_cast<float>(value / light);
    }
    const Metrics metrics = compare(scaled, reference, HdrFlip::leave_out);
    Difference out;
    out.relmse = metrics.relmse_exposed;
    out.bias = metrics.bias;
    out.not_finite = metrics.nan + metrics.inf;
    double mean = 0.0;
    for (const float value : reference.rgb) {
        mean += value;
    }
    mean /= static_cast<double>(std::max<size_t>(reference.rgb.size(), 1));
    size_t changed = 0;
    for (size_t pixel = 0; pixel < reference.rgb.size(); pixel += 3) {
        double worst = 0.0;
        for (size_t i = pixel; i < pixel + 3; ++i) {
            const double a = scaled.rgb[i];
            const double b = reference.rgb[i];
            const double distance = std::abs(a - b);
            worst = std::max(worst, distance > 0.0 ? distance / (std::abs(b) + 0.01 * mean) : 0.0);
        }
        out.worst = std::max(out.worst, worst);
        changed += worst > k_visible ? 1 : 0;
    }
    out.changed =
        3.0 * static_cast<double>(changed) / static_cast<double>(std::max<size_t>(reference.rgb.size(), 1));
    return out;
}

double relmse_bound(Allowed allowed, double own_error, bool redrawn) {
    constexpr double k_of_halves = 1e-8;
    constexpr double k_of_rounding = 1e-5;
    constexpr double k_of_map_texels = 1e-3;
    switch (allowed) {
        case Allowed::nothing:
            return 0.0;
        case Allowed::halves:
            return k_of_halves;
        case Allowed::rounding:
            return redrawn ? std::max(own_error, k_of_rounding) : k_of_rounding;
        case Allowed::sampling:
            break;
    }
    return std::max(own_error, k_of_map_texels);
}

bool holds(const Difference& d, Allowed allowed, double own_error, bool redrawn) {
    constexpr double k_two_halves = 2.0 / 1024.0;
    return d.not_finite == 0 && d.relmse <= relmse_bound(allowed, own_error, redrawn) &&
           (allowed != Allowed::nothing || d.worst == 0.0) &&
           (allowed != Allowed::halves || d.worst <= k_two_halves);
}

}  // namespace bounce::bench
