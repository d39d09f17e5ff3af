// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace bounce::scene {

struct Bounds {
    glm::dvec3 low{1e300};
    glm::dvec3 high{-1e300};
    [[nodiscard]] bool empty() const { return low.x > high.x; }
    [[nodiscard]] glm::dvec3 center() const { return 0.5 * (low + high); }
    [[nodiscard]] double diagonal() const { return empty() ? 0.0 : glm::length(high - low); }
    // Of all six sides.
    [[nodiscard]] double surface_m2() const {
        const glm::dvec3 side = empty() ? glm::dvec3(0.0) : high - low;
        return 2.0 * (side.x * side.y + side.y * side.z + side.z * side.x);
    }
    void grow(const glm::dvec3& point);
    void grow(const Bounds& other);
};

// One mesh drawn once: a node with a mesh, or one of its instances.
struct DrawInstance {
    int node = k_none;
    int mesh = k_none;
    int skin = k_none;  // index into Pose::skins, k_none when rigid
    // For a skinned mesh the identity: the joints place it (glTF 2.0, 3.7.3.3).
    glm::dmat4 world_from_model{1.0};
};

struct LightInstance {
    int node = k_none;
    int light = k_none;                // into Pose::lights
    glm::dmat4 world_from_light{1.0};  // looks along its -Z; keeps the node's scale
};

// The scene at one moment: everything the renderer uploads a frame. Vectors run parallel to Scene's
// where they have the same name.
struct Pose {
    double time_s = 0.0;
    std::vector<glm::dmat4> world_from_node;
    std::vector<std::vector<float>> weights;     // per node; empty where its mesh has no targets
    std::vector<std::vector<glm::dmat4>> skins;  // per skin, per joint: world_from_mesh
    std::vector<DrawInstance> draws;             // visible ones
    std::vector<LightInstance> light_instances;  // visible ones
    std::vector<Light> lights;
    std::vector<Camera> cameras;
    std::vector<Material> materials;
    World world;
    ViewSettings view;
};

// The scene at time_s. animation picks one of Scene::animations; k_all_animations plays every one at
// once (what a file from Blender means; later channels win where two move the same thing).
constexpr int k_all_animations = -1;
[[nodiscard]] Pose evaluate_pose(const Scene& scene, double time_s, int animation = k_all_animations);

// What to play where the user names no animation: every one of a file from Blender, whose animations
// are one scene's; of any other file the first, because its clips are alternatives (walk, run, jump).
[[nodiscard]] int default_animation(const Scene& scene);

// Grows world bounds by one primitive of a draw: its transformed corner box (skinned: of the joints' boxes;
// morphed: with the targets' extremes). Conservative: never too small.
void grow_by_primitive(Bounds& bounds, const Pose& pose, const DrawInstance& draw,
                       const PrimitiveBounds& primitive);

// World bounds of what the pose draws, by grow_by_primitive().
[[nodiscard]] Bounds world_bounds(const Scene& scene, const Pose& pose);

// A camera placed so that the whole scene is in the frame, for files without one: looks at the centre
// from front, right and above. Returns the camera and world_from_camera.
struct PlacedCamera {
    Camera camera;
    glm::dmat4 world_from_camera{1.0};
};
[[nodiscard]] PlacedCamera framing_camera(const Bounds& bounds, double aspect);

}  // namespace bounce::scene
