// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "scene/pose.h"

namespace bounce::gpu {

// World space moved and scaled so that the scene is about one unit large around the origin: scenes of a
// millimetre and of a hundred kilometres, at the origin or 10^6 units away, are the same numbers to
// floats and to half floats. Radiance does not change under it; intensity (W/sr) is multiplied by
// scale^2, because distances are.
struct RenderSpace {
    glm::dvec3 origin{0.0};
    double scale = 1.0;  // render units a metre

    static RenderSpace around(const scene::Bounds& bounds) {
        RenderSpace space;
        if (!bounds.empty()) {
            space.origin = bounds.center();
            const double diagonal = bounds.diagonal();
            space.scale = diagonal > 0.0 ? 1.0 / diagonal : 1.0;
        }
        return space;
    }
    [[nodiscard]] glm::dmat4 render_from_world() const {
        glm::dmat4 matrix(scale);
        matrix[3] = glm::dvec4(-origin * scale, 1.0);
        return matrix;
    }
    [[nodiscard]] glm::dvec3 point(const glm::dvec3& world) const { return (world - origin) * scale; }
};

}  // namespace bounce::gpu
