// SPDX-License-Identifier: Apache-2.0
//
// The surfaces of a scene cut into parts that points are drawn from: what may hide one place of the scene
// from another, and large flat pieces, which at times cannot because the whole scene lies on one side of
// them.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <glm/glm.hpp>

#include "scene/pose.h"
#include "scene/scene.h"

namespace bounce::scene {

// One primitive of one mesh drawn in one place; the same list at every pose, visible or not.
struct PointSurface {
    int node = k_none;
    int instance = 0;  // into Node::instances, 0 where there are none
    int mesh = k_none;
    int primitive = 0;
    bool deforms = false;  // skinned or morphing
};

// Triangles with their areas summed up, for drawing one in proportion to its area.
struct AreaTable {
    std::vector<glm::uvec3> triangles;  // corners: vertices of a primitive; along a space-filling curve
    std::vector<double> cumulative;     // parallel to triangles; any unit
    glm::dvec3 center{0.0};             // mean over the area; model space, or world space of what deforms
    bool flat = false;                  // all in one plane
    glm::dvec3 point{0.0};              // on that plane, model space; flat only
    glm::dvec3 normal{0.0};
};

struct SurfacePart {
    uint32_t surface = 0;
    std::shared_ptr<const AreaTable> table;  // shared by the places where a mesh is drawn
    // What hides: the same surface in the fewest triangles (flat_cover.h). They are not all of the
    // primitive's own, so only places mean something on them, not coordinates of textures. Often the table
    // itself, and always where the material has holes.
    std::shared_ptr<const AreaTable> cover;
    double area_m2 = 0.0;
    glm::dvec3 center_world{0.0};
    bool cut_out = false;  // its material has holes: parts of its triangles are not there
};

struct SurfaceParts {
    std::vector<PointSurface> surfaces;
    std::vector<SurfacePart> parts;  // along a curve through their centres
    double box_surface_m2 = 0.0;  // of the box around all that is drawn at any of the moments sampled
    [[nodiscard]] double area_m2() const;
};

// Cuts the scene. Areas are those at the first frame, deformed as there; a surface that grows or appears
// later counts with its largest area of five moments spread over the animation (as in evaluate_pose).
[[nodiscard]] SurfaceParts surface_parts(const Scene& scene, int animation);

}  // namespace bounce::scene
