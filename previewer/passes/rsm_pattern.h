// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace bounce::passes {

// How the radii of the gather's pattern are spread (Dachsbacher and Stamminger 2005, eq. 3).
enum class RsmPattern {
    // Density falls with the squared distance, as the paper's text has it: xi1 is log-uniform, and the weight
    // that undoes the density is xi1^2.
    inverse_square,
    // Eq. 3 with a uniform xi1: density falls with the distance, and what undoes it is xi1.
    uniform_radius,
    // Eq. 3 to the letter: uniform xi1 and weights xi1^2. The weights do not undo the density, so near light
    // is lost; kept to show by how much.
    paper_literal,
};

// Points of the unit disk: cos and sin of the angle, radius, and the disk area the point stands for. Angles
// follow the golden ratio and radii are stratified, so the points cover the disk evenly at any count, and
// the same count always gives the same points. The areas sum to pi.
[[nodiscard]] std::vector<glm::vec4> make_rsm_pattern(RsmPattern kind, int samples);

}  // namespace bounce::passes
