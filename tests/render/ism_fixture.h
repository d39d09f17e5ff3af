// SPDX-License-Identifier: Apache-2.0
//
// Scenes for light that bounces and is hidden on its way.
#pragma once

#include <algorithm>

#include "render_fixture.h"

namespace bounce::test {

inline glm::dmat4 moved(const glm::dvec3& by) {
    return glm::translate(glm::dmat4(1.0), by);
}

inline glm::dmat4 rotated(double degrees, const glm::dvec3& axis, const glm::dvec3& at = glm::dvec3(0.0)) {
    return glm::rotate(moved(at), degrees * pi / 180.0, axis);
}

// A box from -half to half, facing outwards.
inline int add_box(scene::Scene& scene, const glm::vec3& half, int material) {
    scene::Primitive p;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0F, 1.0F}) {
            const auto first = static_cast<uint32_t>(p.positions.size());
            for (const glm::vec2& corner :
                 {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
                glm::vec3 position(0.0F);
                position[axis] = side;
                position[(axis + 1) % 3] = corner.x * side;
                position[(axis + 2) % 3] = corner.y;
                p.positions.push_back(position * half);
                glm::vec3 normal(0.0F);
                normal[axis] = side;
                p.normals.push_back(normal);
            }
            for (const uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) {
                p.indices.push_back(first + i);
            }
        }
    }
    p.material = material;
    scene.meshes.push_back({"box", {p}, {}});
    return static_cast<int>(scene.meshes.size()) - 1;
}

// A ball of radius 1 and about a thousand triangles: none of them a plane, none large.
inline int add_ball(scene::Scene& scene, int material, float radius) {
    constexpr int rings = 16;
    constexpr int around = 32;
    scene::Primitive p;
    for (int i = 0; i <= rings; ++i) {
        for (int j = 0; j <= around; ++j) {
            const double theta = pi * i / rings;
            const double phi = 2.0 * pi * j / around;
            const glm::vec3 n(glm::dvec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                         std::cos(theta)));
            p.positions.push_back(n * radius);
            p.normals.push_back(n);
            if (i < rings && j < around) {
                const auto a = static_cast<uint32_t>(i * (around + 1) + j);
                const uint32_t b = a + around + 1;
                p.indices.insert(p.indices.end(), {a, b, a + 1, a + 1, b, b + 1});
            }
        }
    }
    p.material = material;
    scene.meshes.push_back({"ball", {p}, {}});
    return static_cast<int>(scene.meshes.size()) - 1;
}

// A room corner: a white floor (normal +Z) and a red wall at x = -2 (normal +X), 4 m wide.
inline scene::Scene corner_scene() {
    scene::Scene scene;
    scene.from_blender = true;
    const int floor = add_square(scene, 4.0F, add_diffuse(scene, glm::vec3(0.8F)));
    const int wall = add_square(scene, 4.0F, add_diffuse(scene, glm::vec3(0.6F, 0.2F, 0.1F)));
    add_mesh_node(scene, floor, glm::dmat4(1.0));
    add_mesh_node(scene, wall, rotated(90.0, {0.0, 1.0, 0.0}, {-2.0, 0.0, 2.0}));
    return scene;
}

inline scene::Light light_of(scene::LightType type) {
    scene::Light light;
    light.type = type;
    light.power_w = 100.0F;
    light.irradiance_w_m2 = 3.0F;
    light.cone_angle_rad = 1.2F;
    light.blend = 0.3F;
    light.size_x_m = light.size_y_m = 0.3F;
    return light;
}

// A spot so narrow that what it lights of the wall, at (-2, 0, 1.5), is one place.
inline void add_pointer(scene::Scene& scene) {
    scene::Light spot = light_of(scene::LightType::spot);
    spot.cone_angle_rad = 0.02F;
    spot.blend = 0.0F;
    add_light(scene, spot, rotated(90.0, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.5}));  // -Z turns to -X
}

inline void add_wall_spot(scene::Scene& scene) {
    add_light(scene, light_of(scene::LightType::spot), rotated(55.0, {0.0, 1.0, 0.0}, {1.0, 0.2, 2.0}));
}

// Light that bounced, alone, on the floor seen from above: 4 m across.
inline Settings bounced(int size) {
    Settings settings;
    settings.width = settings.height = size;
    settings.technique = Technique::ism;
    settings.show = Show::indirect;
    settings.antialias = false;  // pixel by pixel
    return settings;
}

inline CameraView floor_camera() {
    CameraView camera = camera_from_above(4.0, 50.0);
    camera.camera.far_m = 100.0F;
    return camera;
}

// The pixel of `size` a side that shows (x, y) of the floor.
inline glm::ivec2 pixel_of(double x, double y, int size) {
    return {static_cast<int>((x / 4.0 + 0.5) * size), static_cast<int>((0.5 - y / 4.0) * size)};
}

}  // namespace bounce::test
