// SPDX-License-Identifier: Apache-2.0
//
// The colour spaces of FLIP. Linear RGB is Rec. 709 with D65 white, 1 is white.
#pragma once

#include <glm/vec3.hpp>

namespace bounce::flip {

// Linearised CIELab (Zhang and Wandell, 1997, "A spatial extension of CIELAB for digital color image
// reproduction"): Y 0..100, Cx red-green, Cz blue-yellow.
[[nodiscard]] glm::vec3 ycxcz_from_linear(const glm::vec3& linear);
[[nodiscard]] glm::vec3 linear_from_ycxcz(const glm::vec3& ycxcz);

// CIELab, L 0..100.
[[nodiscard]] glm::vec3 lab_from_linear(const glm::vec3& linear);

// Chroma scaled by lightness: colours look less colourful where it is dark (Hunt, 1952).
[[nodiscard]] glm::vec3 hunt_adjusted(const glm::vec3& lab);

// Lightness apart from chroma: |dL| plus the length of d(a, b) (Abasi, Amani Tehran and Fairchild, 2020,
// "Distance metrics for very large color differences").
[[nodiscard]] float hyab(const glm::vec3& a, const glm::vec3& b);

}  // namespace bounce::flip
