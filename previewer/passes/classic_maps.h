// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/ism.h"

namespace bounce::passes {

// The reference that imperfect shadow maps are judged by: the same lights with maps drawn from the scene's
// triangles, in the same atlas format (R32UI, shaders/lib/ism.glsl) and size. Each light sees its hemisphere
// through five faces of a cube, drawn as the scene is; a texel of its parabolic map is then where that
// texel's own ray meets the plane of the triangle the face shows. So no triangle is bent by the projection,
// none needs tessellating, and a texel's distance and slope are exact. Slow: five times the scene for each
// light.
[[nodiscard]] TextureHandle add_classic_maps(FrameGraph& graph, const PassContext& context,
                                             const VplSet& set);

// Faces that one light's map is drawn through.
constexpr int k_classic_faces = 5;

}  // namespace bounce::passes
