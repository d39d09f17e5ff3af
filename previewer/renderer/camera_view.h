// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "gpu/render_space.h"
#include "scene/scene.h"

namespace bounce {

// A camera placed in the world and fitted to a picture.
struct CameraView {
    glm::dmat4 world_from_camera{1.0};  // looks along -Z; scale is ignored, but not its sign
    scene::Camera camera;
    double pixel_aspect = 1.0;  // a pixel's width over its height
    // Where pixels look, from their middles, in pixels: right and up.
    glm::dvec2 offset_px{0.0};
};

// What the shaders need of a view, in render space.
struct CameraMatrices {
    glm::dmat4 clip_from_render{1.0};
    glm::dmat4 render_from_clip{1.0};
    glm::dvec3 position{0.0};
    glm::dvec3 forward{0.0, 0.0, -1.0};
    bool perspective = true;
    // Half the width of a pixel at distance 1 (perspective) or everywhere (orthographic), render units.
    double pixel_radius = 0.0;
};

// The view with an orthographic camera's clip planes drawn in to what the bounds hold. Such a depth is
// linear: in a range of a kilometre its steps are wider than the rounding that shadows allow for. Perspective
// depth has relative steps and stays as it is.
[[nodiscard]] CameraView tighten_orthographic_depth(const CameraView& view, const scene::Bounds& bounds);

// Clip depth is 1 at the near plane and 0 at the far one, or at infinity. With Camera::sensor the frame is
// Blender's for any resolution (sensor fit, shift, pixel aspect as in Blender's camera_view_frame); without
// it yfov or ymag fill the height.
[[nodiscard]] CameraMatrices camera_matrices(const CameraView& view, int width, int height,
                                             const gpu::RenderSpace& space);

}  // namespace bounce
