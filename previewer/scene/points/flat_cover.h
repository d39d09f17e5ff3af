// SPDX-License-Identifier: Apache-2.0
//
// Few triangles for what many cover: a plane that is finely cut, or cut about its holes, is drawn exactly by
// those that its outline needs.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

namespace bounce::scene {

// Triangles that cover the same part of a plane as the given ones, facing the same way; fewer of them, or
// none where there are no fewer. Holes stay, and so do pieces that do not touch. The outline is theirs up to
// two hundred-thousandths of the piece's size, which covers what straight edges stray by in float positions.
//
// positions: any space. triangles: corners, into positions; finite, of some area each, facing one way.
// Returns corners into positions. Empty as well where the triangles bend out of one plane, overlap one
// another or have an outline of more than k_most_cover_corners corners: then they are best left as they are.
[[nodiscard]] std::vector<glm::uvec3> flat_cover(const std::vector<glm::dvec3>& positions,
                                                 const std::vector<glm::uvec3>& triangles);

constexpr size_t k_most_cover_corners = 1024;

}  // namespace bounce::scene
