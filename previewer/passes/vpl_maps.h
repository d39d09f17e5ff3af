// SPDX-License-Identifier: Apache-2.0
//
// How virtual point lights are chosen, and how maps of theirs are drawn from triangles.
#pragma once

namespace bounce::passes {

enum class VplSampling {
    inverse_transform,  // one for each cell of equal flux
    uniform,            // texels at the points of the Halton sequence (Lv et al. 2009)
};

enum class MapProjection {
    faces,       // through five faces of a cube, exact
    paraboloid,  // each vertex by the map's own projection, which bends edges (Brabec et al. 2002)
};

}  // namespace bounce::passes
