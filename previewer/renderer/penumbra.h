// SPDX-License-Identifier: Apache-2.0
//
// How wide a light's penumbra can be, and how fine the picture is. Arithmetic without OpenGL.
#pragma once

#include "renderer/camera_view.h"
#include "scene/pose.h"

namespace bounce {

// Radius (point, spot), half diagonal (area) in metres, or the tangent of half the angle (sun); 0: no size,
// so its shadows are hard.
[[nodiscard]] double light_extent(const scene::LightInstance& instance, const scene::Light& light);

// Metres: no penumbra on a surface within the bounds is wider than this, measured across the light's rays.
// Infinite for a light among the surfaces, whose occluders may touch it.
[[nodiscard]] double widest_penumbra_m(const scene::LightInstance& instance, const scene::Light& light,
                                       const scene::Bounds& bounds);

// Metres: the width of a pixel at the nearest place within the bounds.
[[nodiscard]] double finest_pixel_m(const CameraView& view, const CameraMatrices& camera,
                                    const gpu::RenderSpace& space, const scene::Bounds& bounds);

}  // namespace bounce
