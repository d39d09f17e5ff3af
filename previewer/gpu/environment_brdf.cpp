// SPDX-License-Identifier: Apache-2.0
#include "gpu/environment_brdf.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace bounce::gpu {
namespace {

constexpr int k_samples = 512;
constexpr double k_eta = 1.5;

// How far the Fresnel reflectance has risen from normal incidence, 0, to grazing, 1.
double fresnel_rise(double cosine) {
    const double g = std::sqrt(k_eta * k_eta - 1.0 + cosine * cosine);
    const double a = (g - cosine) / (g + cosine);
    const double b = (cosine * (g + cosine) - 1.0) / (cosine * (g - cosine) + 1.0);
    const double reflectance = 0.5 * a * a * (1.0 + b * b);
    const double f0 = (k_eta - 1.0) * (k_eta - 1.0) / ((k_eta + 1.0) * (k_eta + 1.0));
    return std::clamp((reflectance - f0) / (1.0 - f0), 0.0, 1.0);
}

double smith(double cosine, double alpha2) {
    return 2.0 * cosine / (cosine + std::sqrt(cosine * cosine * (1.0 - alpha2) + alpha2));
}

double radical_inverse(uint32_t i) {
    double value = 0.0;
    for (double digit = 0.5; i > 0; i /= 2, digit *= 0.5) {
        value += (i % 2) * digit;
    }
    return value;
}

// Sums over directions that a lobe reflects: what of it is reflectance at normal incidence and what the
// rise, and the lobe's first moment where all is reflected.
struct Lobe {
    glm::dvec2 reflected{0.0};
    double weight = 0.0;
    glm::dvec3 moment{0.0};
};

Lobe lobe_of(double n_dot_v, double roughness) {
    n_dot_v = std::clamp(n_dot_v, 1e-3, 1.0);
    const double alpha = std::max(roughness * roughness, 1e-3);
    const double alpha2 = alpha * alpha;
    const glm::dvec3 v(std::sqrt(1.0 - n_dot_v * n_dot_v), 0.0, n_dot_v);
    Lobe lobe;
    for (int i = 0; i < k_samples; ++i) {
        // Half vectors by D (n.h): what is left of BRDF times cosine is F G (v.h) / (n.h n.v).
        const double u = (i + 0.5) / k_samples;
        const double phi = 2.0 * std::numbers::pi * radical_inverse(static_cast<uint32_t>(i));
        const double cos2 = (1.0 - u) / (1.0 + (alpha2 - 1.0) * u);
        const double sine = std::sqrt(1.0 - cos2);
        const glm::dvec3 h(sine * std::cos(phi), sine * std::sin(phi), std::sqrt(cos2));
        const double v_dot_h = glm::dot(v, h);
        const double n_dot_l = 2.0 * v_dot_h * h.z - v.z;
        if (v_dot_h <= 0.0 || n_dot_l <= 0.0) {
            continue;
        }
        const double rise = fresnel_rise(v_dot_h);
        const double weight = smith(n_dot_l, alpha2) * smith(n_dot_v, alpha2) * v_dot_h / (h.z * n_dot_v);
        lobe.reflected += weight * glm::dvec2(1.0 - rise, rise);
        lobe.weight += weight;
        lobe.moment += weight * (2.0 * v_dot_h * h - v);
    }
    lobe.reflected /= static_cast<double>(k_samples);
    return lobe;
}

// How far a lobe is from a single direction: 1 - length of its mean direction.
double spread_of(const Lobe& lobe) {
    return 1.0 - glm::length(lobe.moment) / lobe.weight;
}

// Spread of lobes seen head on, by roughness from 0 to 1.
std::vector<double> head_on_spreads() {
    constexpr int k_steps = 256;
    std::vector<double> spreads;
    for (int i = 0; i <= k_steps; ++i) {
        spreads.push_back(spread_of(lobe_of(1.0, i / static_cast<double>(k_steps))));
    }
    return spreads;
}

double head_on_roughness(const std::vector<double>& spreads, double spread) {
    const auto after = std::upper_bound(spreads.begin() + 1, spreads.end(), spread);
    if (after == spreads.end()) {
        return 1.0;
    }
    const auto index = static_cast<double>(after - spreads.begin());
    const double low = *(after - 1);
    const double part = *after > low ? std::clamp((spread - low) / (*after - low), 0.0, 1.0) : 0.0;
    return (index - 1.0 + part) / static_cast<double>(spreads.size() - 1);
}

}  // namespace

glm::dvec2 environment_brdf(double n_dot_v, double roughness) {
    return lobe_of(n_dot_v, roughness).reflected;
}

std::vector<glm::vec4> environment_brdf_table(int size) {
    const std::vector<double> spreads = head_on_spreads();
    std::vector<glm::vec4> table;
    for (int row = 0; row < size; ++row) {
        const double roughness = row / (size - 1.0);
        for (int column = 0; column < size; ++column) {
            const double n_dot_v = column / (size - 1.0);
            const Lobe lobe = lobe_of(n_dot_v, roughness);
            const double turned = std::atan2(lobe.moment.z, -lobe.moment.x) - std::asin(n_dot_v);
            // Below the least roughness that is integrated a lobe is in proportion to the one there.
            const double alike = head_on_roughness(spreads, spread_of(lobe));
            const double floor = std::sqrt(1e-3);
            table.emplace_back(lobe.reflected.x, lobe.reflected.y, turned,
                               alike * std::min(roughness / floor, 1.0));
        }
    }
    return table;
}

}  // namespace bounce::gpu
