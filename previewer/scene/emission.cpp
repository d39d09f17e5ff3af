// SPDX-License-Identifier: Apache-2.0
#include "scene/emission.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "scene/points/outline.h"
#include "scene/pose.h"

namespace bounce::scene {
namespace {

size_t at(int index) {
    return static_cast<size_t>(index);
}

constexpr int k_moments = 9;

}  // namespace

double emitted_luminance(const glm::vec3& radiance) {
    return glm::dot(glm::dvec3(radiance), glm::dvec3(0.2126, 0.7152, 0.0722));
}

std::vector<bool> may_emit(const Scene& scene) {
    std::vector<bool> out;
    for (const Material& material : scene.materials) {
        out.push_back(!material.unlit && emitted_luminance(material.emission) * material.emission_strength > 0.0);
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
    std::map<std::tuple<float, float, float>, uint32_t> places;
    std::vector<uint32_t> welded;
    welded.reserve(primitive.positions.size());
    for (const glm::vec3& p : primitive.positions) {
        welded.push_back(
            places.emplace(std::tuple(p.x, p.y, p.z), static_cast<uint32_t>(places.size())).first->second);
    }
    return welded;
}

bool is_closed(const Primitive& primitive) {
    const std::vector<uint32_t> welded = welded_vertices(primitive);
    std::vector<glm::uvec3> triangles;
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const glm::uvec3 corners(welded[primitive.indices[i]], welded[primitive.indices[i + 1]],
                                 welded[primitive.indices[i + 2]]);
        if (corners.x != corners.y && corners.y != corners.z && corners.z != corners.x) {
            triangles.push_back(corners);
        }
    }
    return !triangles.empty() && find_outlines(triangles).empty();
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
    const bool animated = std::any_of(
        scene.animations.begin(), scene.animations.end(), [](const Animation& candidate) {
            return std::any_of(candidate.channels.begin(), candidate.channels.end(),
                               [](const AnimationChannel& channel) {
                                   return channel.property == Property::material_emission ||
                                          channel.property == Property::material_emission_strength;
                               });
        });
    for (int i = 0; animated && i < k_moments; ++i) {
        const double frame = scene.frames.start +
                             (scene.frames.end - scene.frames.start) * static_cast<double>(i) / (k_moments - 1);
        const std::vector<glm::vec3> now =
            emitted_radiance(evaluate_pose(scene, time_of_frame(scene.frames, frame), animation).materials);
        for (size_t m = 0; m < peak.size(); ++m) {
            peak[m] = emitted_luminance(now[m]) > emitted_luminance(peak[m]) ? now[m] : peak[m];
        }
    }
    return peak;
}

}  // namespace bounce::scene
