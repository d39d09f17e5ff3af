// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace bounce::scene {

// A closed line through vertices, its surface on the left.
using Outline = std::vector<uint32_t>;

// The outlines of a surface: edges that no other triangle runs along the other way, joined to closed lines.
// triangles: corners, counterclockwise; corners that are to be the same have the same number.
[[nodiscard]] std::vector<Outline> find_outlines(std::span<const glm::uvec3> triangles);

// The outlines of what these are outlines of together: without edges that two of them run along in opposite
// ways, as those of neighbours that are straightened do.
[[nodiscard]] std::vector<Outline> join_outlines(std::span<const Outline> outlines);

// The outline without the vertices that straight edges do not need: no vertex left out lies farther than the
// tolerance from the edge that takes its place. Empty where less than a triangle is left (a slit).
// places: of the vertices, any unit, the tolerance's as well.
[[nodiscard]] Outline straighten(const Outline& outline, std::span<const glm::dvec2> places,
                                 double tolerance);

}  // namespace bounce::scene
