// SPDX-License-Identifier: Apache-2.0
#include "scene/points/emitters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "scene/emission.h"
#include "scene/points/point_materials.h"
#include "scene/points/sobol.h"

namespace bounce::scene {
namespace {

constexpr uint32_t k_seed = 0x0e317U;

size_t at(int index) {
    return static_cast<size_t>(index);
}

const Primitive& primitive_of(const Scene& scene, const PointSurface& surface) {
    return scene.meshes[at(surface.mesh)].primitives[at(surface.primitive)];
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
    std::erase_if(triangles_, [](const Triangle& triangle) { return !(emitted_luminance(triangle.texture) > 0.0); });
}

double Emitters::area_m2(const Triangle& triangle) const {
    const SurfacePart& part = parts_.parts[triangle.part];
    const std::vector<double>& sums = part.table->cumulative;
    const double before = triangle.index == 0 ? 0.0 : sums[triangle.index - 1];
    return (sums[triangle.index] - before) / sums.back() * part.area_m2;
}

std::vector<bool> Emitters::taken_by(std::span<const EmissivePanel> panels) const {
    using Corners = std::array<uint32_t, 3>;
    const auto corners = [](const glm::uvec3& t) {
        Corners out{t.x, t.y, t.z};
        std::sort(out.begin(), out.end());
        return out;
    };
    std::vector<bool> out(triangles_.size(), false);
    for (const EmissivePanel& panel : panels) {
        std::set<Corners> own;
        for (const glm::uvec3& triangle : panel.triangles) {
            own.insert(corners(triangle));
        }
        for (size_t i = 0; i < triangles_.size(); ++i) {
            const SurfacePart& part = parts_.parts[triangles_[i].part];
            const PointSurface& surface = parts_.surfaces[part.surface];
            out[i] = out[i] || (surface.node == panel.node && surface.instance == panel.instance &&
                                surface.primitive == panel.primitive &&
                                own.contains(corners(part.table->triangles[triangles_[i].index])));
        }
    }
    return out;
}

std::vector<EmitterSample> Emitters::sample(std::span<const glm::vec3> radiance,
                                            const std::vector<bool>& shown, size_t count,
                                            std::span<const EmissivePanel> panels) const {
    const std::vector<bool> taken = taken_by(panels);
    // Fronts of all triangles, then backs, so that either side is stratified for itself.
    std::vector<double> cumulative;
    cumulative.reserve(2 * triangles_.size());
    double sum = 0.0;
    for (const bool back : {false, true}) {
        for (size_t i = 0; i < triangles_.size(); ++i) {
            const Triangle& triangle = triangles_[i];
            const SurfacePart& part = parts_.parts[triangle.part];
            const int material = primitive_of(scene_, parts_.surfaces[part.surface]).material;
            const bool sends = shown[part.surface] && (!back || triangle.both_sides) && !taken[i];
            sum += sends ? area_m2(triangle) * emitted_luminance(radiance[at(material)] * triangle.texture) : 0.0;
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
        sample.area_m2 = area_m2(triangle) * static_cast<double>(sample.point.share);
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
