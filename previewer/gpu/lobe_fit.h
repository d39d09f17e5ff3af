// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

namespace bounce::gpu {

// A linearly transformed cosine (Heitz et al. 2016, "Real-Time Polygonal-Light Shading with Linearly
// Transformed Cosines") in the place of a GGX lobe: a clamped cosine whose directions are moved by a matrix.
// Local space has Z along the normal and X towards where the view is mirrored. With theta the angle between
// normal and viewer and psi = theta + asin(sin_shift), what the cosine's Z axis is moved to, the matrix's
// inverse has the rows
//     (cos psi, 0, -sin psi) / (in_plane alpha)
//     (0, 1, 0) / (across alpha)
//     (0, 0, 1) / cos psi
// and leaves the horizon where it is: nothing of the lobe is under it, and a light is cut off where the
// surface cuts it off. (The paper's matrix has one number more, which moves the horizon; it fits hardly
// better.) alpha: squared roughness, at least k_least_alpha.
struct LobeFit {
    double in_plane = 2.0;
    double across = 2.0;
    double sin_shift = 0.0;
};

// shaders/lib/brdf.glsl has the same.
inline constexpr double k_least_alpha = 1e-3;
// Views that are flatter are taken for this one; shaders/lib/lobe.glsl has the same.
inline constexpr double k_least_cosine = 0.01;

// BRDF times cosine of the law in shaders/lib/brdf.glsl with a reflectance of 1, per steradian; `to_light` is
// a unit vector in local space. n_dot_v: cosine between normal and viewer, at least k_least_cosine.
[[nodiscard]] double ggx_times_cosine(double n_dot_v, double roughness, const glm::dvec3& to_light);

// What the fit has in its place: its integral over all directions is 1.
[[nodiscard]] double lobe_density(const LobeFit& fit, double n_dot_v, double roughness,
                                  const glm::dvec3& to_light);

struct FittedLobe {
    LobeFit fit;
    double error = 0.0;  // integral of (f - g)^2 / (f + g), 0 to 2, f and g with integrals of 1
};

// The fit with the least such error: relative where a lobe has its light, so that what it sends beside its
// peak counts as well. By Nelder and Mead's simplex (1965, "A Simplex Method for Function Minimization") from
// `start`.
[[nodiscard]] FittedLobe fit_lobe(double n_dot_v, double roughness, const LobeFit& start);

}  // namespace bounce::gpu
