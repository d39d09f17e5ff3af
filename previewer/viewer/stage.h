// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "renderer/renderer.h"
#include "scene/gltf_loader.h"
#include "scene/pose.h"

namespace bounce::viewer {

// Which of a scene's animations to play; throws Error where there is none such.
using ChooseAnimation = std::function<int(const scene::Scene&)>;

// A scene with all that depends on it: replaced as a whole when the file is loaded again.
class Stage {
  public:
    Stage(scene::LoadResult loaded, const ChooseAnimation& choose_animation);

    void set_time(double time_s);
    [[nodiscard]] const scene::Scene& scene() const { return loaded_.scene; }
    [[nodiscard]] const scene::Pose& pose() const { return pose_; }
    [[nodiscard]] const std::vector<std::string>& warnings() const { return loaded_.warnings; }
    [[nodiscard]] scene::Bounds bounds() const { return scene::world_bounds(scene(), pose_); }
    [[nodiscard]] Renderer& renderer() { return renderer_; }

    // Nodes that hold cameras.
    [[nodiscard]] const std::vector<int>& cameras() const { return cameras_; }
    [[nodiscard]] std::string camera_name(int node) const;
    // Of this name; k_none where there is none.
    [[nodiscard]] int find_camera(const std::string& name) const;
    // The view of a camera node; k_none: what scene_camera() gives where none is named.
    [[nodiscard]] CameraView camera_view(int node, int width, int height) const;
    // The lights that have a reflective shadow map, as Settings::shown_light counts them.
    [[nodiscard]] std::vector<std::string> shown_lights(const Settings& settings) const;

  private:
    scene::LoadResult loaded_;
    int animation_;
    scene::Pose pose_;
    std::vector<int> cameras_;
    Renderer renderer_;
};

}  // namespace bounce::viewer
