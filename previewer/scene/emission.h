// SPDX-License-Identifier: Apache-2.0
//
// What materials emit, and which side of a surface does.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include <glm/glm.hpp>

#include "scene/pose.h"
#include "scene/scene.h"

namespace bounce::scene {

[[nodiscard]] double emitted_luminance(const glm::vec3& radiance);

// One a material: whether it emits at some time, by its factor or by an animation that may raise it.
[[nodiscard]] std::vector<bool> may_emit(const Scene& scene);

// What each of the scene's materials sends at its brightest, luminance by luminance, of nine moments spread
// over the animation (as in evaluate_pose), those of the keys of emission, and the file's own values; without
// textures, W/(m^2 sr). Samples in proportion to it stay where they are while emission changes.
[[nodiscard]] std::vector<glm::vec3> peak_radiance(const Scene& scene, int animation);

// What each material sends at a pose, without textures, W/(m^2 sr); an unlit one nothing.
[[nodiscard]] std::vector<glm::vec3> emitted_radiance(const std::vector<Material>& materials);

// A number for each of the primitive's vertices, the same where they are at one place, but for a
// hundred-thousandth of the primitive's size.
[[nodiscard]] std::vector<uint32_t> welded_vertices(const Primitive& primitive);

// Which sides of a surface send light: front is where its triangles turn counter-clockwise.
struct EmittingSides {
    bool front = true;
    bool back = true;
};

// Both, as in Cycles, but where that would only light the inside of an empty body: a closed surface without
// holes around nothing sends by its outside alone, whichever way its triangles turn. What lies inside of what
// is told by boxes where the file's range of frames begins; a surface around the whole scene is around
// something.
class EmittingSidesFinder {
  public:
    explicit EmittingSidesFinder(const Scene& scene);  // must outlive it
    [[nodiscard]] EmittingSides find(int node, int instance, int primitive);

  private:
    struct Place {
        int node;
        int instance;
        int primitive;
        Bounds box;
    };
    [[nodiscard]] bool is_around_something(int node, int instance, int primitive) const;

    const Scene& scene_;
    std::vector<Place> places_;
    Bounds all_;
    std::map<const Primitive*, int> outside_;  // 1: front, -1: back, 0: it is not closed
};

}  // namespace bounce::scene
