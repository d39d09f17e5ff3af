// SPDX-License-Identifier: Apache-2.0
#include "bench/motions.h"

#include <glm/gtc/matrix_transform.hpp>

#include "scene/animation.h"

namespace bounce::bench {
namespace {

size_t at(int index) {
    return static_cast<size_t>(index);
}

// The draw with the largest extent below half of the scene's; k_none where there is none.
int find_object(const scene::Scene& scene, const scene::Pose& pose, double diagonal) {
    int found = scene::k_none;
    double extent = 0.0;
    for (size_t i = 0; i < pose.draws.size(); ++i) {
        scene::Bounds bounds;
        for (const scene::Primitive& primitive : scene.meshes[at(pose.draws[i].mesh)].primitives) {
            scene::grow_by_primitive(bounds, pose, pose.draws[i], primitive.bounds);
        }
        if (pose.draws[i].skin == scene::k_none && bounds.diagonal() > extent &&
            bounds.diagonal() < diagonal / 2.0) {
            extent = bounds.diagonal();
            found = static_cast<int>(i);
        }
    }
    return found;
}

scene::Pose pose_at(const BenchInputs& inputs, double frame) {
    return scene::evaluate_pose(inputs.scene, scene::time_of_frame(inputs.scene.frames, frame),
                                scene::default_animation(inputs.scene));
}

// Aside, or, where only its direction counts, turned by as many radians as the step has diagonals.
void move_light(const scene::Pose& pose, scene::LightInstance& light, const glm::dvec3& by, double radians) {
    if (pose.lights[at(light.light)].type == scene::LightType::sun) {
        light.world_from_light =
            light.world_from_light * glm::rotate(glm::dmat4(1.0), radians, glm::dvec3(0.0, 1.0, 0.0));
    } else {
        light.world_from_light[3] += glm::dvec4(by, 0.0);
    }
}

}  // namespace

std::vector<Motion> scene_motions(const BenchInputs& inputs, const Settings& settings, double step,
                                  BenchReport& report) {
    const scene::Scene& scene = inputs.scene;
    const scene::Pose still = pose_at(inputs, inputs.frame());
    const auto camera_of = [&scene, &inputs, settings](const scene::Pose& pose) {
        return scene_camera(scene, pose, inputs.options.camera, settings.width, settings.height);
    };
    const double diagonal = scene::world_bounds(scene, still).diagonal();
    const glm::dvec3 along(diagonal * step, 0.0, 0.0);
    std::vector<Motion> out;
    out.push_back({"nothing", true, [=](int) { return Shot{still, camera_of(still)}; }});
    out.push_back({"the camera", false, [=](int frame) {
                       CameraView view = camera_of(still);
                       view.world_from_camera =
                           view.world_from_camera *
                           glm::translate(glm::dmat4(1.0), along * static_cast<double>(frame));
                       return Shot{still, view};
                   }});
    if (const int object = find_object(scene, still, diagonal); object != scene::k_none) {
        out.push_back({"an object", false, [=](int frame) {
                           Shot shot{still, camera_of(still)};
                           const glm::dvec3 by = along * static_cast<double>(frame);
                           const int node = shot.pose.draws[at(object)].node;
                           shot.pose.world_from_node[at(node)][3] += glm::dvec4(by, 0.0);
                           for (scene::DrawInstance& draw : shot.pose.draws) {
                               draw.world_from_model[3] +=
                                   draw.node == node ? glm::dvec4(by, 0.0) : glm::dvec4(0.0);
                           }
                           return shot;
                       }});
    } else {
        report.notes.emplace_back("nothing is small enough to be moved as an object");
    }
    if (!still.light_instances.empty()) {
        out.push_back({"a light", false, [=](int frame) {
                           Shot shot{still, camera_of(still)};
                           move_light(shot.pose, shot.pose.light_instances[0],
                                      along * static_cast<double>(frame), step * frame);
                           return shot;
                       }});
    }
    if (!scene.animations.empty()) {
        out.push_back({"the scene's animation", false, [=, &inputs](int frame) {
                           const scene::Pose pose = pose_at(inputs, inputs.frame() + frame);
                           return Shot{pose, camera_of(pose)};
                       }});
    }
    return out;
}

Motion turntable(const BenchInputs& inputs, const Settings& settings, double step_deg) {
    const scene::Pose still = pose_at(inputs, inputs.frame());
    const CameraView first =
        scene_camera(inputs.scene, still, inputs.options.camera, settings.width, settings.height);
    const glm::dvec3 middle = scene::world_bounds(inputs.scene, still).center();
    return {"the camera, around a still set", false, [=](int frame) {
                CameraView view = first;
                const glm::dmat4 turn =
                    glm::translate(glm::dmat4(1.0), middle) *
                    glm::rotate(glm::dmat4(1.0), glm::radians(step_deg * frame), glm::dvec3(0.0, 1.0, 0.0)) *
                    glm::translate(glm::dmat4(1.0), -middle);
                view.world_from_camera = turn * first.world_from_camera;
                return Shot{still, view};
            }};
}

std::optional<Motion> walk_through(const BenchInputs& inputs, const Settings& settings) {
    const auto camera_of = [&inputs, settings](const scene::Pose& pose) {
        return scene_camera(inputs.scene, pose, inputs.options.camera, settings.width, settings.height);
    };
    const scene::Pose still = pose_at(inputs, inputs.frame());
    if (camera_of(still).world_from_camera ==
        camera_of(pose_at(inputs, inputs.frame() + 1.0)).world_from_camera) {
        return std::nullopt;
    }
    return Motion{"the camera, as animated", false, [=, &inputs](int frame) {
                      return Shot{still, camera_of(pose_at(inputs, inputs.frame() + frame))};
                  }};
}

}  // namespace bounce::bench
