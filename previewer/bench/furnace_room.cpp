// SPDX-License-Identifier: Apache-2.0
#include "bench/furnace_room.h"

#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "bench/room.h"

namespace bounce::bench {
namespace {

constexpr int k_segments = 96;
constexpr int k_rings = 48;
constexpr double pi = std::numbers::pi;

// Towards each of the six sides, and an up that is square to it.
struct Side {
    glm::dvec3 to;
    glm::dvec3 up;
};
constexpr Side k_sides[6] = {{{1, 0, 0}, {0, 1, 0}},  {{-1, 0, 0}, {0, 1, 0}}, {{0, 1, 0}, {0, 0, 1}},
                             {{0, -1, 0}, {0, 0, 1}}, {{0, 0, 1}, {0, 1, 0}},  {{0, 0, -1}, {0, 1, 0}}};

// Seen from within, normals inwards.
scene::Primitive cube_walls() {
    scene::Primitive out;
    for (const Side& side : k_sides) {
        const glm::dvec3 right = glm::cross(side.to, side.up);
        const auto first = static_cast<uint32_t>(out.positions.size());
        for (const glm::dvec2& corner : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
            out.positions.emplace_back(side.to + right * corner.x + side.up * corner.y);
            out.normals.emplace_back(-side.to);
        }
        for (const uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) {
            out.indices.push_back(first + corner);
        }
    }
    return out;
}

scene::Primitive sphere_wall() {
    scene::Primitive out;
    for (int ring = 0; ring <= k_rings; ++ring) {
        for (int segment = 0; segment <= k_segments; ++segment) {
            const double theta = pi * ring / k_rings;
            const double phi = 2.0 * pi * segment / k_segments;
            const glm::dvec3 place(std::sin(theta) * std::cos(phi), std::cos(theta),
                                   std::sin(theta) * std::sin(phi));
            out.positions.emplace_back(place);
            out.normals.emplace_back(-place);
        }
    }
    const auto at = [](int ring, int segment) {
        return static_cast<uint32_t>(ring * (k_segments + 1) + segment);
    };
    for (int ring = 0; ring < k_rings; ++ring) {
        for (int segment = 0; segment < k_segments; ++segment) {
            const uint32_t a = at(ring, segment);
            const uint32_t b = at(ring + 1, segment);
            const uint32_t c = at(ring + 1, segment + 1);
            const uint32_t d = at(ring, segment + 1);
            // Poles have one triangle a segment. Fronts are inwards.
            if (ring + 1 < k_rings) {
                out.indices.insert(out.indices.end(), {a, b, c});
            }
            if (ring > 0) {
                out.indices.insert(out.indices.end(), {a, c, d});
            }
        }
    }
    return out;
}

double area_m2(const scene::Primitive& primitive) {
    double sum = 0.0;
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const glm::dvec3 a(primitive.positions[primitive.indices[i]]);
        const glm::dvec3 b(primitive.positions[primitive.indices[i + 1]]);
        const glm::dvec3 c(primitive.positions[primitive.indices[i + 2]]);
        sum += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    return sum;
}

scene::Primitive walls(FurnaceShape shape) {
    return shape == FurnaceShape::cube ? cube_walls() : sphere_wall();
}

}  // namespace

scene::Scene make_furnace(const Furnace& furnace) {
    scene::Scene scene;
    scene.name = furnace.shape == FurnaceShape::cube ? "a closed cube" : "a closed sphere";
    scene.from_blender = true;
    scene::Material white;
    white.name = "white";
    white.base_color = glm::vec4(glm::vec3(furnace.albedo), 1.0F);
    white.metallic = 0.0F;
    white.specular = 0.0F;
    white.double_sided = true;
    if (furnace.light == FurnaceLight::emission) {
        white.emission = glm::vec3(k_furnace_emission);
    }
    scene.materials.push_back(white);
    scene::Primitive primitive = walls(furnace.shape);
    primitive.material = 0;
    scene.meshes.push_back({"walls", {std::move(primitive)}, {}});
    scene::Node node;
    node.name = "walls";
    node.mesh = 0;
    add_root(scene, std::move(node));
    if (furnace.light == FurnaceLight::point) {
        scene::Light light;
        light.name = "lamp";
        light.type = scene::LightType::point;
        light.power_w = k_furnace_power_w;
        scene.lights.push_back(light);
        scene::Node lamp;
        lamp.name = "lamp";
        lamp.light = 0;
        lamp.local.translation = {0.3, -0.2, 0.15};
        add_root(scene, std::move(lamp));
    }
    return scene;
}

std::vector<CameraView> furnace_cameras(FurnaceShape shape) {
    std::vector<CameraView> out;
    for (const Side& side : k_sides) {
        CameraView view;
        view.world_from_camera = glm::inverse(glm::lookAt(glm::dvec3(0.0), side.to, side.up));
        view.camera.near_m = 0.01F;
        view.camera.far_m = 4.0F;
        view.camera.perspective = shape == FurnaceShape::sphere;
        view.camera.yfov_rad = static_cast<float>(pi / 2.0);
        view.camera.xmag = view.camera.ymag = 1.0F;
        out.push_back(view);
    }
    return out;
}

double furnace_radiance(const Furnace& furnace, int bounces) {
    const auto albedo = static_cast<double>(furnace.albedo);
    const bool emits = furnace.light == FurnaceLight::emission;
    double sum = 0.0;
    for (int k = 0; k <= bounces + (emits ? 1 : 0); ++k) {
        sum += std::pow(albedo, k);
    }
    return emits ? k_furnace_emission * sum
                 : albedo / pi * k_furnace_power_w / area_m2(walls(furnace.shape)) * sum;
}

}  // namespace bounce::bench
