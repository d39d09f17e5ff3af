// SPDX-License-Identifier: Apache-2.0
#include "evaluate/scene_defaults.h"

#include "evaluate/scene_files.h"
#include "scene/gltf_loader.h"
#include "scene/pose.h"

namespace bounce {
namespace {

using nlohmann::json;

json framed(const scene::Scene& scene, int frame, double aspect) {
    const double time_s = scene::time_of_frame(scene.frames, frame);
    const scene::Pose pose = scene::evaluate_pose(scene, time_s, scene::default_animation(scene));
    const scene::PlacedCamera placed = scene::framing_camera(scene::world_bounds(scene, pose), aspect);
    json columns = json::array();
    for (int column = 0; column < 4; ++column) {
        const glm::dvec4& values = placed.world_from_camera[column];
        columns.push_back({values.x, values.y, values.z, values.w});
    }
    return {{"frame", frame},
            {"world_from_camera", columns},
            {"yfov_rad", placed.camera.yfov_rad},
            {"near_m", placed.camera.near_m},
            {"far_m", placed.camera.far_m}};
}

}  // namespace

json scene_defaults(const std::filesystem::path& gltf, const std::vector<int>& frames, int width,
                    int height) {
    if (is_blend(gltf) || !is_gltf(gltf)) {
        return nullptr;
    }
    const scene::Scene scene = scene::load_gltf(gltf).scene;
    json result;
    if (scene.active_camera_node != scene::k_none) {
        result["camera_node"] = scene.active_camera_node;
    } else {
        result["cameras"] = json::array();
        for (const int frame : frames) {
            result["cameras"].push_back(framed(scene, frame, static_cast<double>(width) / height));
        }
    }
    const glm::vec3& color = scene.world.color;
    result["world"] = {{"color", {color.r, color.g, color.b}}, {"strength", scene.world.strength}};
    return result;
}

}  // namespace bounce
