// SPDX-License-Identifier: Apache-2.0
#include "bench/room.h"

#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "scene/primitive_bounds.h"

namespace bounce::bench {
namespace {

int add_material(scene::Scene& scene, const char* name, const glm::vec3& color) {
    scene::Material material;
    material.name = name;
    material.base_color = glm::vec4(color, 1.0F);
    material.metallic = 0.0F;
    material.roughness = 0.8F;
    scene.materials.push_back(std::move(material));
    return static_cast<int>(scene.materials.size()) - 1;
}

int add_mesh(scene::Scene& scene, const char* name, scene::Primitive primitive, int material) {
    primitive.material = material;
    primitive.bounds = scene::primitive_bounds(primitive);
    scene.meshes.push_back({name, {std::move(primitive)}, {}});
    return static_cast<int>(scene.meshes.size()) - 1;
}

void add_quad(scene::Primitive& out, const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
    const auto first = static_cast<uint32_t>(out.positions.size());
    const glm::vec3 normal = glm::normalize(glm::cross(u, v));
    for (const glm::vec3& position : {corner, corner + u, corner + u + v, corner + v}) {
        out.positions.push_back(position);
        out.normals.push_back(normal);
    }
    for (const uint32_t index : {0U, 1U, 2U, 0U, 2U, 3U}) {
        out.indices.push_back(first + index);
    }
}

// A box's faces; seen from inside where `inward`.
scene::Primitive box(const glm::vec3& low, const glm::vec3& high, bool inward) {
    scene::Primitive out;
    const glm::vec3 size = high - low;
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 u(0.0F);
        glm::vec3 v(0.0F);
        u[(axis + 1) % 3] = size[(axis + 1) % 3];
        v[(axis + 2) % 3] = size[(axis + 2) % 3];
        glm::vec3 far = low;
        far[axis] = high[axis];
        add_quad(out, far, inward ? v : u, inward ? u : v);
        add_quad(out, low, inward ? u : v, inward ? v : u);
    }
    return out;
}

// segments: around; rings: from pole to pole.
scene::Primitive unit_sphere(int segments, int rings) {
    scene::Primitive out;
    for (int ring = 0; ring <= rings; ++ring) {
        const double theta = std::numbers::pi * ring / rings;
        for (int segment = 0; segment <= segments; ++segment) {
            const double phi = 2.0 * std::numbers::pi * segment / segments;
            const glm::vec3 place(glm::dvec3(std::sin(theta) * std::cos(phi), std::cos(theta),
                                             -std::sin(theta) * std::sin(phi)));
            out.positions.push_back(place);
            out.normals.push_back(place);
        }
    }
    for (int ring = 0; ring < rings; ++ring) {
        for (int segment = 0; segment < segments; ++segment) {
            const auto upper = static_cast<uint32_t>(ring * (segments + 1) + segment);
            const auto lower = static_cast<uint32_t>(upper + segments + 1);
            out.indices.insert(out.indices.end(), {upper, lower, lower + 1, upper, lower + 1, upper + 1});
        }
    }
    return out;
}

void add_mesh_node(scene::Scene& scene, const char* name, int mesh, const glm::dvec3& place = glm::dvec3(0.0),
                   double size = 1.0) {
    scene::Node node;
    node.name = name;
    node.mesh = mesh;
    node.local.translation = place;
    node.local.scale = glm::dvec3(size);
    add_root(scene, std::move(node));
}

glm::dmat4 looking(const glm::dvec3& from, const glm::dvec3& at) {
    return glm::inverse(glm::lookAt(from, at, glm::dvec3(0.0, 1.0, 0.0)));
}

}  // namespace

void add_root(scene::Scene& scene, scene::Node node) {
    const auto index = static_cast<int>(scene.nodes.size());
    scene.nodes.push_back(std::move(node));
    scene.roots.push_back(index);
    scene.topological_order.push_back(index);
}

scene::Scene make_room(int segments) {
    scene::Scene scene;
    scene.name = "a generated room with spheres";
    const int white = add_material(scene, "white", glm::vec3(0.75F));
    const int red = add_material(scene, "red", glm::vec3(0.65F, 0.08F, 0.06F));
    const int green = add_material(scene, "green", glm::vec3(0.1F, 0.45F, 0.12F));
    const int blue = add_material(scene, "blue", glm::vec3(0.15F, 0.25F, 0.7F));

    scene::Primitive walls;
    scene::Primitive left;
    scene::Primitive right;
    add_quad(walls, {-3, 0, -2}, {0, 0, 4}, {6, 0, 0});  // floor
    add_quad(walls, {-3, 3, -2}, {6, 0, 0}, {0, 0, 4});  // ceiling
    add_quad(walls, {-3, 0, -2}, {6, 0, 0}, {0, 3, 0});  // back
    add_quad(walls, {-3, 0, 2}, {0, 3, 0}, {6, 0, 0});   // front
    add_quad(left, {-3, 0, -2}, {0, 3, 0}, {0, 0, 4});
    add_quad(right, {3, 0, -2}, {0, 0, 4}, {0, 3, 0});
    add_mesh_node(scene, "Walls", add_mesh(scene, "walls", std::move(walls), white));
    add_mesh_node(scene, "Left wall", add_mesh(scene, "left wall", std::move(left), red));
    add_mesh_node(scene, "Right wall", add_mesh(scene, "right wall", std::move(right), green));
    add_mesh_node(scene, "Screen",
                  add_mesh(scene, "screen", box({-0.6F, 0.0F, -0.5F}, {-0.5F, 2.2F, 1.2F}, false), white));

    const int ball = add_mesh(scene, "ball", unit_sphere(segments, segments / 2), white);
    const int blue_ball = add_mesh(scene, "blue ball", unit_sphere(segments, segments / 2), blue);
    for (int i = 0; i < 12; ++i) {
        const double size = 0.18 + 0.06 * (i % 4);
        const glm::dvec3 place(-2.5 + 1.0 * (i % 6), i < 6 ? size : 1.4 + 0.2 * (i % 3),
                               i % 2 == 0 ? -1.2 : 0.3);
        add_mesh_node(scene, "Ball", i % 3 == 0 ? blue_ball : ball, place, size);
    }

    scene::Light spot;
    spot.name = "Spot";
    spot.type = scene::LightType::spot;
    spot.power_w = 400.0F;
    spot.cone_angle_rad = 1.4F;
    spot.blend = 0.3F;
    scene.lights.push_back(spot);
    scene::Node light;
    light.name = "Spot";
    light.light = 0;
    light.matrix = looking({-1.6, 2.7, 0.8}, {-2.2, 0.0, -0.6});
    add_root(scene, std::move(light));

    scene::Camera camera;
    camera.name = "Camera";
    camera.yfov_rad = 0.95F;
    camera.near_m = 0.05F;
    camera.far_m = 20.0F;
    scene.cameras.push_back(camera);
    scene::Node node;
    node.name = "Camera";
    node.camera = 0;
    node.matrix = looking({0.8, 1.6, 1.9}, {-0.2, 1.1, -1.0});
    scene.active_camera_node = static_cast<int>(scene.nodes.size());
    add_root(scene, std::move(node));
    return scene;
}

}  // namespace bounce::bench
