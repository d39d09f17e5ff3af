// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "renderer/camera_view.h"
#include "scene/pose.h"

namespace bounce::viewer {

// A camera that the mouse moves around a pivot. It starts as any view, exactly, and keeps its lens.
// Drags are in heights of the window, right and down positive, so that they mean the same at any size.
class CameraControls {
  public:
    // The pivot is the point on the view's axis nearest the scene's centre, in front of the camera.
    CameraControls(const CameraView& view, const scene::Bounds& bounds);

    // Turns about the upright axis and tilts, up to straight down and straight up; the horizon keeps its
    // roll.
    void orbit(double right, double down);
    // Moves with what lies at the pivot's distance.
    void pan(double right, double down, int width, int height);
    // A step is a tick of the wheel; positive goes nearer.
    void zoom(double steps);
    // Puts the whole scene into the middle of the frame, seen from the same side.
    void frame_all(const scene::Bounds& bounds, int width, int height);

    // The camera, with near and far planes that leave the scene whole.
    [[nodiscard]] CameraView view() const;
    [[nodiscard]] const glm::dvec3& pivot() const { return pivot_; }
    [[nodiscard]] double distance() const { return distance_; }

  private:
    [[nodiscard]] glm::dmat3 world_from_camera() const;
    // Metres that the window's height shows at the pivot.
    [[nodiscard]] double visible_height(int width, int height) const;
    void scale_orthographic(double factor);

    CameraView lens_;  // its matrix is unused
    glm::dvec3 scene_center_{0.0};
    double scene_radius_ = 1.0;
    glm::dvec3 pivot_{0.0};
    double distance_ = 1.0;
    // The rotation is Ry(yaw) Rx(pitch) Rz(roll).
    double yaw_ = 0.0;
    double pitch_ = 0.0;
    double roll_ = 0.0;
};

}  // namespace bounce::viewer
