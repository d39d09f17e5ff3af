// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "viewer/camera_controls.h"
#include "viewer/stage.h"

namespace bounce::viewer {

// From where the scene is seen: one of its cameras, or a free camera that started there.
class Viewpoint {
  public:
    // node: of a camera; k_none where the scene has none and is framed as a whole.
    explicit Viewpoint(int node) : node_(node) {}

    // Looks through a camera of the scene.
    void look_through(int node);
    // The next camera in the scene's order, the first after the last. The scene has one.
    void look_through_next(const Stage& stage);
    // The free camera; looking through one of the scene's, it starts there.
    CameraControls& free(const Stage& stage, int width, int height);
    // The scene was replaced by another version of it: finds the camera again by its name.
    void move_to(const Stage& before, const Stage& after);

    [[nodiscard]] CameraView view(const Stage& stage, int width, int height) const;
    [[nodiscard]] bool is_free() const { return controls_.has_value(); }
    [[nodiscard]] int node() const { return node_; }

  private:
    int node_;
    std::optional<CameraControls> controls_;
};

}  // namespace bounce::viewer
