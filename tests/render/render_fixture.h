// SPDX-License-Identifier: Apache-2.0
//
// Scenes made of numbers, and one OpenGL context a process to draw them with.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "gl/context.h"
#include "renderer/renderer.h"
#include "scene/pose.h"
#include "scene/scene.h"

namespace bounce::test {

inline constexpr double pi = std::numbers::pi;

// A test binary that finds no OpenGL fails: software GL is one of the packages that scripts/install_deps
// lists.
inline void require_context() {
    static const gl::HeadlessContext context;
    static const gl::DeviceInfo device = gl::initialise_current_context();
    ASSERT_FALSE(device.renderer.empty());
}

inline int add_node(scene::Scene& scene, scene::Node node) {
    scene.nodes.push_back(std::move(node));
    const int index = static_cast<int>(scene.nodes.size()) - 1;
    scene.roots.push_back(index);
    scene.topological_order.push_back(index);
    return index;
}

// A white Lambertian, or another plain diffuse colour.
inline int add_diffuse(scene::Scene& scene, const glm::vec3& color = glm::vec3(1.0F)) {
    scene::Material material;
    material.name = "diffuse";
    material.base_color = glm::vec4(color, 1.0F);
    material.metallic = 0.0F;
    material.specular = 0.0F;
    material.double_sided = true;
    scene.materials.push_back(material);
    return static_cast<int>(scene.materials.size()) - 1;
}

// A square of side `size` in the node's XY plane, normal +Z.
inline int add_square(scene::Scene& scene, float size, int material) {
    const float h = 0.5F * size;
    scene::Primitive primitive;
    primitive.positions = {{-h, -h, 0.0F}, {h, -h, 0.0F}, {h, h, 0.0F}, {-h, h, 0.0F}};
    primitive.normals.assign(4, {0.0F, 0.0F, 1.0F});
    primitive.indices = {0, 1, 2, 0, 2, 3};
    primitive.material = material;
    scene.meshes.push_back({"square", {primitive}, {}});
    return static_cast<int>(scene.meshes.size()) - 1;
}

inline int add_mesh_node(scene::Scene& scene, int mesh, const glm::dmat4& matrix) {
    scene::Node node;
    node.name = "mesh";
    node.mesh = mesh;
    node.matrix = matrix;
    return add_node(scene, node);
}

inline int add_light(scene::Scene& scene, const scene::Light& light, const glm::dmat4& matrix) {
    scene.lights.push_back(light);
    scene::Node node;
    node.name = "light";
    node.light = static_cast<int>(scene.lights.size()) - 1;
    node.matrix = matrix;
    return add_node(scene, node);
}

// Looks down -Z from `height`, an orthographic frame `width` metres wide.
inline CameraView camera_from_above(double width, double height, double scale = 1.0) {
    CameraView view;
    view.world_from_camera = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, height * scale));
    view.camera.perspective = false;
    view.camera.xmag = static_cast<float>(0.5 * width * scale);
    view.camera.ymag = view.camera.xmag;
    view.camera.near_m = static_cast<float>(0.01 * scale);
    view.camera.far_m = static_cast<float>(2.0 * height * scale);
    return view;
}

struct Rendered {
    Image image;
    FrameReport report;
    [[nodiscard]] glm::dvec3 at(int x, int y) const {
        const size_t i = image.offset(x, y);
        return {image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]};
    }
    [[nodiscard]] double mean() const {
        double sum = 0.0;
        for (const float value : image.rgb) {
            sum += value;
        }
        return sum / static_cast<double>(image.rgb.size());
    }
};

inline Rendered draw(Renderer& renderer, const scene::Pose& pose, const CameraView& camera,
                     const Settings& settings) {
    Rendered out;
    out.report = renderer.render(pose, camera, settings);
    out.image = renderer.read_color();
    for (const float value : out.image.rgb) {
        EXPECT_TRUE(std::isfinite(value));
        if (!std::isfinite(value)) {
            break;
        }
    }
    return out;
}

inline Rendered draw(const scene::Scene& scene, const CameraView& camera, const Settings& settings,
                     double time_s = 0.0) {
    Renderer renderer(scene);
    return draw(renderer, scene::evaluate_pose(scene, time_s), camera, settings);
}

}  // namespace bounce::test
