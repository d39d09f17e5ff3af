// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <vector>

#include "scene/points/surface_parts.h"

namespace bounce::scene {

// Finds the flat parts that lie on the scene's hull: everything visible is on one side of their plane, up to
// a thousandth of the scene's diagonal. No straight line between two places of the scene passes through such
// a part, so it hides nothing from anything (a closed room's walls, the ground under a scene).
class HullFinder {
  public:
    HullFinder(const Scene& scene, const SurfaceParts& parts) : scene_(scene), parts_(parts) {}

    // One answer a part. A function of the pose alone; keeps what it found out about meshes at rest.
    [[nodiscard]] std::vector<bool> on_hull(const Pose& pose);

  private:
    // How far a rigid primitive reaches along a direction of its model space.
    double reach(int mesh, int primitive, const glm::dvec3& direction);
    // Whether all that is drawn lies below the plane {x: normal.x = offset} (world space).
    bool everything_below(const Pose& pose, const glm::dvec3& normal, double offset);

    const Scene& scene_;
    const SurfaceParts& parts_;
    std::map<std::pair<std::pair<int, int>, std::array<double, 3>>, double> reaches_;
};

}  // namespace bounce::scene
