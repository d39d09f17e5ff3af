// SPDX-License-Identifier: Apache-2.0
//
// What materials emit, and which side of a surface does.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace bounce::scene {

[[nodiscard]] double emitted_luminance(const glm::vec3& radiance);

// One a material: whether it emits at some time, by its factor or by an animation that may raise it.
[[nodiscard]] std::vector<bool> may_emit(const Scene& scene);

// What each of the scene's materials sends at its brightest, luminance by luminance, of nine moments spread over
// the animation (as in evaluate_pose) and the file's own values; without textures, W/(m^2 sr). Samples in
// proportion to it stay where they are while emission changes.
[[nodiscard]] std::vector<glm::vec3> peak_radiance(const Scene& scene, int animation);

// What each material sends at a pose, without textures, W/(m^2 sr); an unlit one nothing.
[[nodiscard]] std::vector<glm::vec3> emitted_radiance(const std::vector<Material>& materials);

// A number for each of the primitive's vertices, the same where they are at one place.
[[nodiscard]] std::vector<uint32_t> welded_vertices(const Primitive& primitive);

// Whether the surface has no border: each edge is run along once in each direction. Vertices at one place are
// one.
[[nodiscard]] bool is_closed(const Primitive& primitive);

}  // namespace bounce::scene
