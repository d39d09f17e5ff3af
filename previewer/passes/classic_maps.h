// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/ism.h"
#include "passes/vpl_maps.h"

namespace bounce::passes {

// The reference that imperfect shadow maps are judged by: the same lights with maps drawn from the scene's
// triangles, in the same atlas format (R32UI, shaders/lib/ism.glsl) and size. Each light sees its hemisphere
// through five faces of a cube, drawn as the scene is; a texel of its parabolic map is then where that
// texel's own ray meets the plane of the triangle the face shows. So no triangle is bent by the projection,
// none needs tessellating, and a texel's distance and slope are exact. Slow: five times the scene for each
// light.
//
// With Geometry::simplified a surface is set back by what it moved when it was simplified, so that it does
// not hide the one that it stands for; nor does it hide a light that is nearer to its plane than that.
//
// MapProjection::paraboloid draws the scene once for each light, as Lv et al. 2009 do: each vertex goes to
// its place in the map, and what lies between goes along straight lines, which the triangle's edges are not.
// Where the bent triangle covers a texel, its distance and slope are exact as before.
[[nodiscard]] TextureHandle add_classic_maps(FrameGraph& graph, const PassContext& context, const VplSet& set,
                                             gpu::Geometry geometry, MapProjection projection);

// Faces that one light's map is drawn through.
constexpr int k_classic_faces = 5;

}  // namespace bounce::passes
