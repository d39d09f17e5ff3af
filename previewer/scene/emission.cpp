// SPDX-License-Identifier: Apache-2.0
#include "scene/emission.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "scene/animated_state.h"
#include "scene/points/outline.h"
#include "scene/pose.h"

namespace bounce::scene {
namespace {

size_t at(int index) {
    return static_cast<size_t>(index);
}

constexpr int k_moments = 9;

// Of a box's side: what reaches no farther in than this, such as a lamp's socket, is not inside.
constexpr double k_inside = 0.1;

// The side of a closed surface that looks outwards, 1 the front and -1 the back; 0 where it has a border: an
// edge that is not run along once in each direction.
int outside_of(const Primitive& primitive) {
    const std::vector<uint32_t> welded = welded_vertices(primitive);
    std::vector<glm::uvec3> triangles;
    double volume = 0.0;
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const glm::uvec3 corners(welded[primitive.indices[i]], welded[primitive.indices[i + 1]],
                                 welded[primitive.indices[i + 2]]);
        if (corners.x == corners.y || corners.y == corners.z || corners.z == corners.x) {
            continue;
        }
        triangles.push_back(corners);
        const glm::dvec3 origin(primitive.positions.front());
        const glm::dvec3 a = glm::dvec3(primitive.positions[primitive.indices[i]]) - origin;
        const glm::dvec3 b = glm::dvec3(primitive.positions[primitive.indices[i + 1]]) - origin;
        const glm::dvec3 c = glm::dvec3(primitive.positions[primitive.indices[i + 2]]) - origin;
        volume += glm::dot(a, glm::cross(b, c));
    }
    if (triangles.empty() || !find_outlines(triangles).empty()) {
        return 0;
    }
    return volume > 0.0 ? 1 : volume < 0.0 ? -1 : 0;
}

}  // namespace

double emitted_luminance(const glm::vec3& radiance) {
    return glm::dot(glm::dvec3(radiance), glm::dvec3(0.2126, 0.7152, 0.0722));
}

std::vector<bool> may_emit(const Scene& scene) {
    std::vector<bool> out;
    for (const Material& material : scene.materials) {
        out.push_back(!material.unlit &&
                      emitted_luminance(material.emission) * material.emission_strength > 0.0);
    }
    for (const Animation& animation : scene.animations) {
        for (const AnimationChannel& channel : animation.channels) {
            const bool emits = channel.property == Property::material_emission ||
                               channel.property == Property::material_emission_strength;
            if (emits && !scene.materials[at(channel.index)].unlit) {
                out[at(channel.index)] = true;
            }
        }
    }
    return out;
}

std::vector<uint32_t> welded_vertices(const Primitive& primitive) {
    Box box;
    for (const glm::vec3& p : primitive.positions) {
        box.grow(p);
    }
    const glm::dvec3 side = box.empty() ? glm::dvec3(0.0) : glm::dvec3(box.high) - glm::dvec3(box.low);
    const double step = std::max({side.x, side.y, side.z, 1e-30}) * 1e-5;
    std::map<std::tuple<int64_t, int64_t, int64_t>, uint32_t> places;
    std::vector<uint32_t> welded;
    welded.reserve(primitive.positions.size());
    for (const glm::vec3& p : primitive.positions) {
        const glm::dvec3 cell = (glm::dvec3(p) - glm::dvec3(box.low)) / step;
        const auto key = std::tuple(std::llround(cell.x), std::llround(cell.y), std::llround(cell.z));
        welded.push_back(places.emplace(key, static_cast<uint32_t>(places.size())).first->second);
    }
    return welded;
}

EmittingSidesFinder::EmittingSidesFinder(const Scene& scene) : scene_(scene) {
    const Pose pose =
        evaluate_pose(scene, time_of_frame(scene.frames, scene.frames.start), default_animation(scene));
    for (const int n : scene.topological_order) {
        const Node& node = scene.nodes[at(n)];
        if (node.mesh == k_none) {
            continue;
        }
        const std::vector<Primitive>& primitives = scene.meshes[at(node.mesh)].primitives;
        for (size_t p = 0; p < primitives.size(); ++p) {
            for (size_t i = 0; i < std::max<size_t>(node.instances.size(), 1); ++i) {
                glm::dmat4 world = pose.world_from_node[at(n)];
                world = node.instances.empty() ? world : world * node.instances[i];
                Place place{n, static_cast<int>(i), static_cast<int>(p), {}};
                for (const glm::vec3& position : primitives[p].positions) {
                    place.box.grow(glm::dvec3(world * glm::dvec4(glm::dvec3(position), 1.0)));
                }
                all_.grow(place.box);
                places_.push_back(place);
            }
        }
    }
}

EmittingSides EmittingSidesFinder::find(int node, int instance, int primitive) {
    const Primitive& surface = scene_.meshes[at(scene_.nodes[at(node)].mesh)].primitives[at(primitive)];
    const auto known = outside_.find(&surface);
    const int outside = known != outside_.end()
                            ? known->second
                            : outside_.emplace(&surface, outside_of(surface)).first->second;
    const bool holes =
        surface.material != k_none && scene_.materials[at(surface.material)].alpha_mode != AlphaMode::opaque;
    if (outside == 0 || holes || is_around_something(node, instance, primitive)) {
        return {};
    }
    return {outside > 0, outside < 0};
}

bool EmittingSidesFinder::is_around_something(int node, int instance, int primitive) const {
    const auto own = std::find_if(places_.begin(), places_.end(), [&](const Place& p) {
        return p.node == node && p.instance == instance && p.primitive == primitive;
    });
    if (own == places_.end() || own->box.empty()) {
        return false;
    }
    const glm::dvec3 room = k_inside * (own->box.high - own->box.low);
    const glm::dvec3 low = own->box.low + room;
    const glm::dvec3 high = own->box.high - room;
    const bool all = glm::all(glm::lessThanEqual(own->box.low, all_.low)) &&
                     glm::all(glm::greaterThanEqual(own->box.high, all_.high));
    return all || std::any_of(places_.begin(), places_.end(), [&](const Place& other) {
               return &other != &*own && !other.box.empty() && glm::all(glm::lessThan(other.box.low, high)) &&
                      glm::all(glm::greaterThan(other.box.high, low)) &&
                      // What is larger runs through it or around it.
                      glm::length(other.box.high - other.box.low) < glm::length(own->box.high - own->box.low);
           });
}

std::vector<glm::vec3> emitted_radiance(const std::vector<Material>& materials) {
    std::vector<glm::vec3> out;
    out.reserve(materials.size());
    for (const Material& material : materials) {
        out.push_back(material.unlit ? glm::vec3(0.0F) : material.emission * material.emission_strength);
    }
    return out;
}

std::vector<glm::vec3> peak_radiance(const Scene& scene, int animation) {
    std::vector<glm::vec3> peak = emitted_radiance(scene.materials);
    const bool animated =
        std::any_of(scene.animations.begin(), scene.animations.end(), [](const Animation& candidate) {
            return std::any_of(candidate.channels.begin(), candidate.channels.end(),
                               [](const AnimationChannel& channel) {
                                   return channel.property == Property::material_emission ||
                                          channel.property == Property::material_emission_strength;
                               });
        });
    std::set<double> moments;
    for (int i = 0; animated && i < k_moments; ++i) {
        moments.insert(
            time_of_frame(scene.frames, scene.frames.start + (scene.frames.end - scene.frames.start) *
                                                                 static_cast<double>(i) / (k_moments - 1)));
    }
    // A flash is brightest at a key of its own.
    for (const Animation& candidate : scene.animations) {
        for (const AnimationChannel& channel : candidate.channels) {
            if (channel.property == Property::material_emission ||
                channel.property == Property::material_emission_strength) {
                const std::vector<float>& keys = candidate.samplers[at(channel.sampler)].times;
                moments.insert(keys.begin(), keys.end());
            }
        }
    }
    for (const double time_s : moments) {
        const std::vector<glm::vec3> now = emitted_radiance(play_materials(scene, time_s, animation));
        for (size_t m = 0; m < peak.size(); ++m) {
            peak[m] = emitted_luminance(now[m]) > emitted_luminance(peak[m]) ? now[m] : peak[m];
        }
    }
    return peak;
}

}  // namespace bounce::scene
