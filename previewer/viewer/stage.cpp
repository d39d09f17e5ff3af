// SPDX-License-Identifier: Apache-2.0
#include "viewer/stage.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace bounce::viewer {

Stage::Stage(scene::LoadResult loaded, const ChooseAnimation& choose_animation)
    : loaded_(std::move(loaded)),
      animation_(choose_animation(loaded_.scene)),
      pose_(scene::evaluate_pose(loaded_.scene, 0.0, animation_)),
      renderer_(loaded_.scene) {
    renderer_.expect_frames(true);
    std::copy_if(scene().topological_order.begin(), scene().topological_order.end(),
                 std::back_inserter(cameras_),
                 [&](int node) { return scene().nodes[static_cast<size_t>(node)].camera != scene::k_none; });
}

void Stage::set_time(double time_s) {
    pose_ = scene::evaluate_pose(scene(), time_s, animation_);
}

std::string Stage::camera_name(int node) const {
    const std::string& name = scene().nodes[static_cast<size_t>(node)].name;
    return name.empty() ? fmt::format("camera at node {}", node) : name;
}

int Stage::find_camera(const std::string& name) const {
    const auto found =
        std::find_if(cameras_.begin(), cameras_.end(), [&](int node) { return camera_name(node) == name; });
    return found == cameras_.end() ? scene::k_none : *found;
}

CameraView Stage::camera_view(int node, int width, int height) const {
    if (node == scene::k_none) {
        return scene_camera(scene(), pose_, "", width, height);
    }
    const auto index = static_cast<size_t>(node);
    const scene::RenderSettings& render = scene().render;
    return {.world_from_camera = pose_.world_from_node[index],
            .camera = pose_.cameras[static_cast<size_t>(scene().nodes[index].camera)],
            .pixel_aspect = static_cast<double>(render.pixel_aspect_x / render.pixel_aspect_y)};
}

std::vector<std::string> Stage::shown_lights(const Settings& settings) const {
    std::vector<std::string> names;
    for (const int index : plan_frame(scene(), pose_, settings).lights) {
        const scene::LightInstance& instance = pose_.light_instances[static_cast<size_t>(index)];
        const std::string& name = scene().nodes[static_cast<size_t>(instance.node)].name;
        names.push_back(name.empty() ? fmt::format("light {}", names.size()) : name);
    }
    return names;
}

}  // namespace bounce::viewer
