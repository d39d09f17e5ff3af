// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/points/surface_parts.h"

namespace bounce::scene {

// The widest plane on the scene's hull, and what stands on it. Seen from within the scene nothing but the
// plane's own surfaces lies beyond the box around all the rest, and those cannot hide one another: so
// whatever hides one place from another, or from the sky, is in the box or is that plane.
struct Ground {
    std::vector<bool> surfaces;  // one a surface of SurfaceParts: lies in the plane as a whole
    Bounds rest;  // around all others that are drawn; of all where there is no such plane or no rest
};

// on_hull: one entry a part (HullFinder), of this pose.
[[nodiscard]] Ground find_ground(const Scene& scene, const Pose& pose, const SurfaceParts& parts,
                                 const std::vector<bool>& on_hull);

}  // namespace bounce::scene
