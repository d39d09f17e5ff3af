// SPDX-License-Identifier: Apache-2.0
#include "scene/points/emitters.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "scene/points/outline.h"
#include "scene/points/point_materials.h"
#include "scene/points/sobol.h"

namespace bounce::scene {
namespace {

constexpr uint32_t k_seed = 0x0e317U;

size_t at(int index) {
    return static_cast<size_t>(index);
}

double luminance(const glm::vec3& color) {
    return glm::dot(glm::dvec3(color), glm::dvec3(0.2126, 0.7152, 0.0722));
}

const Primitive& primitive_of(const Scene& scene, const PointSurface& surface) {
    return scene.meshes[at(surface.mesh)].primitives[at(surface.primitive)];
}

// Materials that emit at some time: by their factor, or by an animation that may raise it.
std::vector<bool> may_emit(const Scene& scene) {
    std::vector<bool> out;
    for (const Material& material : scene.materials) {
        out.push_back(!material.unlit && luminance(material.emission) * material.emission_strength > 0.0);
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

// Whether the surface has no border: each edge is run along once in each direction. Vertices at one place are
// one.
bool is_closed(const Primitive& primitive) {
    std::map<std::tuple<float, float, float>, uint32_t> places;
    std::vector<uint32_t> welded;
    welded.reserve(primitive.positions.size());
    for (const glm::vec3& p : primitive.positions) {
        welded.push_back(
            places.emplace(std::tuple(p.x, p.y, p.z), static_cast<uint32_t>(places.size())).first->second);
    }
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

PointSample middle_of(uint32_t surface, const glm::uvec3& triangle) {
    PointSample sample;
    sample.surface = surface;
    sample.triangle = triangle;
    sample.second = sample.third = 1.0F / 3.0F;
    sample.share = 1.0F;
    return sample;
}

}  // namespace

Emitters::Emitters(const Scene& scene, const SurfaceParts& parts)
    : scene_(scene), parts_(parts), textures_(scene) {
    const std::vector<bool> emits = may_emit(scene);
    std::map<const Primitive*, bool> closed;
    std::vector<PointSample> middles;
    for (size_t p = 0; p < parts.parts.size(); ++p) {
        const SurfacePart& part = parts.parts[p];
        const Primitive& primitive = primitive_of(scene, parts.surfaces[part.surface]);
        if (primitive.material == k_none || !emits[at(primitive.material)] || !(part.area_m2 > 0.0)) {
            continue;
        }
        const bool holes = scene.materials[at(primitive.material)].alpha_mode != AlphaMode::opaque;
        const auto known = closed.find(&primitive);
        const bool is_shut = known != closed.end()
                                 ? known->second
                                 : closed.emplace(&primitive, is_closed(primitive)).first->second;
        for (size_t i = 0; i < part.table->triangles.size(); ++i) {
            triangles_.push_back({p, static_cast<uint32_t>(i), glm::vec3(1.0F), holes || !is_shut});
            middles.push_back(middle_of(part.surface, part.table->triangles[i]));
        }
    }
    const std::vector<glm::vec3> textures = point_emissions(scene, parts, middles, textures_);
    for (size_t i = 0; i < triangles_.size(); ++i) {
        triangles_[i].texture = textures[i];
    }
    std::erase_if(triangles_, [](const Triangle& triangle) { return !(luminance(triangle.texture) > 0.0); });
}

double Emitters::area_m2(const Triangle& triangle) const {
    const SurfacePart& part = parts_.parts[triangle.part];
    const std::vector<double>& sums = part.table->cumulative;
    const double before = triangle.index == 0 ? 0.0 : sums[triangle.index - 1];
    return (sums[triangle.index] - before) / sums.back() * part.area_m2;
}

std::vector<EmitterSample> Emitters::sample(std::span<const glm::vec3> radiance,
                                            const std::vector<bool>& shown, size_t count) const {
    // Fronts of all triangles, then backs, so that either side is stratified for itself.
    std::vector<double> cumulative;
    cumulative.reserve(2 * triangles_.size());
    double sum = 0.0;
    for (const bool back : {false, true}) {
        for (const Triangle& triangle : triangles_) {
            const SurfacePart& part = parts_.parts[triangle.part];
            const int material = primitive_of(scene_, parts_.surfaces[part.surface]).material;
            const bool sends = shown[part.surface] && (!back || triangle.both_sides);
            sum += sends ? area_m2(triangle) * luminance(radiance[at(material)] * triangle.texture) : 0.0;
            cumulative.push_back(sum);
        }
    }
    std::vector<EmitterSample> out;
    if (!(sum > 0.0) || !std::isfinite(sum)) {
        return out;
    }
    std::vector<PointSample> points;
    for (size_t i = 0; i < count; ++i) {
        const glm::dvec3 u = sobol_point(static_cast<uint32_t>(i), k_seed);
        const auto found = std::upper_bound(cumulative.begin(), cumulative.end(), u.x * sum);
        const size_t entry = std::min(static_cast<size_t>(found - cumulative.begin()), cumulative.size() - 1);
        const Triangle& triangle = triangles_[entry % triangles_.size()];
        const double weight = cumulative[entry] - (entry == 0 ? 0.0 : cumulative[entry - 1]);
        // Uniform over a triangle: Osada et al. 2002, "Shape Distributions".
        const double root = std::sqrt(u.y);
        EmitterSample& sample = out.emplace_back();
        const SurfacePart& part = parts_.parts[triangle.part];
        sample.point.surface = part.surface;
        sample.point.triangle = part.table->triangles[triangle.index];
        sample.point.second = static_cast<float>(root * (1.0 - u.z));
        sample.point.third = static_cast<float>(root * u.z);
        sample.point.share = static_cast<float>(sum / static_cast<double>(count) / weight);
        sample.point.flat = part.table->flat;
        sample.back = entry >= triangles_.size();
        points.push_back(sample.point);
    }
    const std::vector<glm::vec3> textures = point_emissions(scene_, parts_, points, textures_);
    for (size_t i = 0; i < out.size(); ++i) {
        out[i].texture = textures[i];
    }
    return out;
}

}  // namespace bounce::scene
