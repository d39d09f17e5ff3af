// SPDX-License-Identifier: Apache-2.0
#include "scene/emissive_panels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <string>

#include "scene/emission.h"

namespace bounce::scene {
namespace {

// Of a rectangle's area that its triangles may lack or exceed, and of a right angle's cosine: rounding of
// vertices.
constexpr double k_tolerance = 1e-3;

size_t at(int index) {
    return static_cast<size_t>(index);
}

glm::dvec3 corner(const Primitive& primitive, uint32_t vertex) {
    return glm::dvec3(primitive.positions[vertex]);
}

glm::dvec3 across(const Primitive& primitive, const glm::uvec3& t) {
    const glm::dvec3 a = corner(primitive, t.x);
    return glm::cross(corner(primitive, t.y) - a, corner(primitive, t.z) - a);
}

// Triangles with an area that share an edge and a plane.
std::vector<std::vector<glm::uvec3>> flat_pieces(const Primitive& primitive) {
    const std::vector<uint32_t> welded = welded_vertices(primitive);
    std::vector<glm::uvec3> triangles;
    std::vector<glm::dvec3> normals;
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const glm::uvec3 t(primitive.indices[i], primitive.indices[i + 1], primitive.indices[i + 2]);
        const glm::dvec3 n = across(primitive, t);
        if (glm::length(n) > 0.0) {
            triangles.push_back(t);
            normals.push_back(glm::normalize(n));
        }
    }
    std::vector<size_t> piece(triangles.size());
    std::iota(piece.begin(), piece.end(), size_t{0});
    const auto root = [&](size_t i) {
        while (piece[i] != i) {
            i = piece[i] = piece[piece[i]];
        }
        return i;
    };
    std::map<std::pair<uint32_t, uint32_t>, size_t> edges;
    for (size_t i = 0; i < triangles.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            const uint32_t a = welded[triangles[i][k]];
            const uint32_t b = welded[triangles[i][(k + 1) % 3]];
            const auto [found, is_new] = edges.emplace(std::minmax(a, b), i);
            if (!is_new && glm::dot(normals[i], normals[found->second]) > 1.0 - 1e-6) {
                piece[root(i)] = root(found->second);
            }
        }
    }
    std::map<size_t, std::vector<glm::uvec3>> pieces;
    for (size_t i = 0; i < triangles.size(); ++i) {
        pieces[root(i)].push_back(triangles[i]);
    }
    std::vector<std::vector<glm::uvec3>> out;
    for (auto& [first, list] : pieces) {
        out.push_back(std::move(list));
    }
    return out;
}

// Fills in where the rectangle is; false where the triangles are none.
bool fit_rectangle(const Primitive& primitive, EmissivePanel& panel) {
    const glm::uvec3& first = panel.triangles.front();
    const glm::dvec3 normal = glm::normalize(across(primitive, first));
    const glm::dvec3 origin = corner(primitive, first.x);
    double area = 0.0;
    for (const glm::uvec3& t : panel.triangles) {
        area += 0.5 * glm::length(across(primitive, t));
    }
    for (int k = 0; k < 3; ++k) {
        // One edge of any triangle of a rectangle cut up along its sides runs along one of them.
        const glm::dvec3 x =
            glm::normalize(corner(primitive, first[(k + 1) % 3]) - corner(primitive, first[k]));
        const glm::dvec3 y = glm::cross(normal, x);
        glm::dvec3 low(std::numeric_limits<double>::max());
        glm::dvec3 high(-std::numeric_limits<double>::max());
        for (const glm::uvec3& t : panel.triangles) {
            for (int i = 0; i < 3; ++i) {
                const glm::dvec3 d = corner(primitive, t[i]) - origin;
                const glm::dvec3 p(glm::dot(d, x), glm::dot(d, y), glm::dot(d, normal));
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
        }
        const glm::dvec3 size = high - low;
        if (std::abs(size.x * size.y - area) <= k_tolerance * area &&
            size.z <= k_tolerance * std::min(size.x, size.y)) {
            const glm::dvec3 middle = 0.5 * (low + high);
            panel.center = origin + x * middle.x + y * middle.y + normal * middle.z;
            panel.half_x = x * (0.5 * size.x);
            panel.half_y = y * (0.5 * size.y);
            return true;
        }
    }
    return false;
}

glm::dmat4 world_from_model(const Scene& scene, const Pose& pose, const EmissivePanel& panel) {
    const Node& node = scene.nodes[at(panel.node)];
    const glm::dmat4& world_from_node = pose.world_from_node[at(panel.node)];
    return node.instances.empty() ? world_from_node : world_from_node * node.instances[at(panel.instance)];
}

// A side of the panel as a light; false where a transform has made it something else than a rectangle.
bool panel_light(const EmissivePanel& panel, const glm::dmat4& world, const glm::vec3& radiance, bool back,
                 double offset_m, Light& light, glm::dmat4& world_from_light) {
    const glm::dvec3 x = glm::dmat3(world) * panel.half_x;
    const glm::dvec3 y = glm::dmat3(world) * panel.half_y;
    const glm::dvec3 n = glm::cross(x, y);
    const double area = 4.0 * glm::length(n);
    if (!(area > 0.0) || !std::isfinite(area) ||
        std::abs(glm::dot(x, y)) > k_tolerance * glm::length(x) * glm::length(y)) {
        return false;
    }
    const bool mirrored = glm::determinant(glm::dmat3(world)) < 0.0;
    const glm::dvec3 axis = glm::normalize(n) * (back != mirrored ? -1.0 : 1.0);
    const float brightest = std::max({radiance.r, radiance.g, radiance.b});
    light.type = LightType::area;
    light.shape = AreaShape::rectangle;
    light.color = radiance / brightest;
    light.power_w = static_cast<float>(4.0 * area * static_cast<double>(brightest));  // L = P / (4 A)
    light.size_x_m = static_cast<float>(2.0 * glm::length(x));
    light.size_y_m = static_cast<float>(2.0 * glm::length(y));
    const glm::dvec3 right = glm::normalize(x);
    const glm::dvec3 place = glm::dvec3(world * glm::dvec4(panel.center, 1.0)) + axis * offset_m;
    world_from_light = glm::dmat4(glm::dvec4(right, 0.0), glm::dvec4(glm::cross(-axis, right), 0.0),
                                  glm::dvec4(-axis, 0.0), glm::dvec4(place, 1.0));
    return std::isfinite(light.power_w);
}

}  // namespace

EmissivePanels find_emissive_panels(const Scene& scene, size_t most_lights) {
    const std::vector<bool> emits = may_emit(scene);
    const Pose pose =
        evaluate_pose(scene, time_of_frame(scene.frames, scene.frames.start), default_animation(scene));
    const std::vector<glm::vec3> radiance = peak_radiance(scene, default_animation(scene));
    struct Candidate {
        EmissivePanel panel;
        double power;
    };
    std::vector<Candidate> candidates;
    EmittingSidesFinder sides(scene);
    size_t others = 0;
    for (const int n : scene.topological_order) {
        const Node& node = scene.nodes[at(n)];
        if (node.mesh == k_none) {
            continue;
        }
        const std::vector<Primitive>& primitives = scene.meshes[at(node.mesh)].primitives;
        for (size_t p = 0; p < primitives.size(); ++p) {
            const Primitive& primitive = primitives[p];
            if (primitive.material == k_none || !emits[at(primitive.material)]) {
                continue;
            }
            const Material& material = scene.materials[at(primitive.material)];
            if (material.emission_texture.present() || material.alpha_mode != AlphaMode::opaque ||
                node.skin != k_none || !primitive.targets.empty()) {
                ++others;
                continue;
            }
            for (const std::vector<glm::uvec3>& triangles : flat_pieces(primitive)) {
                EmissivePanel panel{n, 0, node.mesh, static_cast<int>(p), triangles, {}, {}, {}, {}};
                if (!fit_rectangle(primitive, panel)) {
                    ++others;
                    continue;
                }
                const size_t places = std::max<size_t>(node.instances.size(), 1);
                for (size_t i = 0; i < places; ++i) {
                    panel.instance = static_cast<int>(i);
                    panel.sides = sides.find(n, panel.instance, panel.primitive);
                    const glm::dmat3 world(world_from_model(scene, pose, panel));
                    const double area =
                        4.0 * glm::length(glm::cross(world * panel.half_x, world * panel.half_y));
                    candidates.push_back({panel, area * emitted_luminance(radiance[at(primitive.material)])});
                }
            }
        }
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.power > b.power; });
    EmissivePanels out;
    size_t lights = 0;
    for (Candidate& candidate : candidates) {
        lights += (candidate.panel.sides.front ? 1U : 0U) + (candidate.panel.sides.back ? 1U : 0U);
        if (lights > most_lights) {
            break;
        }
        out.panels.push_back(std::move(candidate.panel));
    }
    out.all = others == 0 && out.panels.size() == candidates.size();
    return out;
}

PanelPose with_panel_lights(const Scene& scene, const Pose& pose, std::span<const EmissivePanel> panels,
                            double offset_m) {
    PanelPose out{pose, {}};
    std::vector<bool> drawn(scene.nodes.size(), false);
    for (const DrawInstance& draw : pose.draws) {
        drawn[at(draw.node)] = true;
    }
    const std::vector<glm::vec3> radiance = emitted_radiance(pose.materials);
    for (const EmissivePanel& panel : panels) {
        const Primitive& primitive = scene.meshes[at(panel.mesh)].primitives[at(panel.primitive)];
        const glm::vec3& sent = radiance[at(primitive.material)];
        if (!drawn[at(panel.node)]) {
            continue;
        }
        if (!(std::max({sent.r, sent.g, sent.b}) > 0.0F)) {
            out.lit.push_back(panel);  // it sends nothing by whatever means
            continue;
        }
        const glm::dmat4 world = world_from_model(scene, pose, panel);
        bool lit = false;
        for (const bool back : {false, true}) {
            Light light;
            glm::dmat4 world_from_light(1.0);
            if (!(back ? panel.sides.back : panel.sides.front) ||
                !panel_light(panel, world, sent, back, offset_m, light, world_from_light)) {
                continue;
            }
            light.name = "emissive " + scene.nodes[at(panel.node)].name + (back ? ", back" : "");
            out.pose.light_instances.push_back(
                {panel.node, static_cast<int>(out.pose.lights.size()), world_from_light});
            out.pose.lights.push_back(light);
            lit = true;
        }
        if (lit) {
            out.lit.push_back(panel);
        }
    }
    return out;
}

}  // namespace bounce::scene
