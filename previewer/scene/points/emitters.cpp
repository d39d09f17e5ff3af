// SPDX-License-Identifier: Apache-2.0
#include "scene/points/emitters.h"

#include <algorithm>
#include <array>
#include <cmath>
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

// A textured triangle is cut into this many pieces a side at most, of about this many texels each, and all of
// them into so many in all.
constexpr int k_most_cuts = 16;
constexpr double k_texels_a_piece = 2.0;
constexpr size_t k_most_pieces = 1U << 18U;

int cuts(double texels) {
    int n = 1;
    while (n < k_most_cuts && 4.0 * n * n * k_texels_a_piece <= texels) {
        n *= 2;
    }
    return n;
}

PointSample middle_of(uint32_t surface, const glm::uvec3& triangle, const std::array<glm::vec2, 3>& corners,
                      float share) {
    const glm::vec2 middle = (corners[0] + corners[1] + corners[2]) / 3.0F;
    PointSample sample;
    sample.surface = surface;
    sample.triangle = triangle;
    sample.second = middle.x;
    sample.third = middle.y;
    sample.share = share;
    return sample;
}

}  // namespace

Emitters::Emitters(const Scene& scene, const SurfaceParts& parts)
    : scene_(scene), parts_(parts), textures_(scene) {
    const std::vector<bool> emits = may_emit(scene);
    EmittingSidesFinder sides(scene);
    for (size_t p = 0; p < parts.parts.size(); ++p) {
        const SurfacePart& part = parts.parts[p];
        const PointSurface& surface = parts.surfaces[part.surface];
        const Primitive& primitive = primitive_of(scene, surface);
        if (primitive.material == k_none || !emits[at(primitive.material)] || !(part.area_m2 > 0.0)) {
            continue;
        }
        const EmittingSides send = sides.find(surface.node, surface.instance, surface.primitive);
        for (size_t i = 0; i < part.table->triangles.size(); ++i) {
            add_pieces(p, static_cast<uint32_t>(i), send);
        }
    }
    std::vector<PointSample> middles;
    middles.reserve(pieces_.size());
    for (const Piece& piece : pieces_) {
        const SurfacePart& part = parts.parts[piece.part];
        middles.push_back(
            middle_of(part.surface, part.table->triangles[piece.index], piece.corners, piece.share));
    }
    const std::vector<glm::vec3> textures = point_emissions(scene, parts, middles, textures_);
    for (size_t i = 0; i < pieces_.size(); ++i) {
        pieces_[i].texture = textures[i];
    }
    std::erase_if(pieces_, [](const Piece& piece) { return !(emitted_luminance(piece.texture) > 0.0); });
}

void Emitters::add_pieces(size_t part, uint32_t index, const EmittingSides& sides) {
    const SurfacePart& of = parts_.parts[part];
    const Primitive& primitive = primitive_of(scene_, parts_.surfaces[of.surface]);
    const Material& material = scene_.materials[at(primitive.material)];
    const int n =
        pieces_.size() < k_most_pieces
            ? cuts(textures_.texels(material.emission_texture, primitive, of.table->triangles[index]))
            : 1;
    const auto place = [&](int x, int y) { return glm::vec2(x, y) / static_cast<float>(n); };
    const float share = 1.0F / static_cast<float>(n * n);
    for (int y = 0; y < n; ++y) {
        // There and back again, so that neighbours in the list are neighbours on the triangle.
        for (int i = 0; i + y < n; ++i) {
            const int x = y % 2 == 0 ? i : n - 1 - y - i;
            pieces_.push_back(
                {part, index, {place(x, y), place(x + 1, y), place(x, y + 1)}, share, {}, sides});
            if (x + y + 1 < n) {
                pieces_.push_back(
                    {part, index, {place(x + 1, y), place(x + 1, y + 1), place(x, y + 1)}, share, {}, sides});
            }
        }
    }
}

double Emitters::area_m2(const Piece& piece) const {
    const SurfacePart& part = parts_.parts[piece.part];
    const std::vector<double>& sums = part.table->cumulative;
    const double before = piece.index == 0 ? 0.0 : sums[piece.index - 1];
    return (sums[piece.index] - before) / sums.back() * part.area_m2 * static_cast<double>(piece.share);
}

std::vector<bool> Emitters::taken_by(std::span<const EmissivePanel> panels) const {
    using Corners = std::array<uint32_t, 3>;
    const auto corners = [](const glm::uvec3& t) {
        Corners out{t.x, t.y, t.z};
        std::sort(out.begin(), out.end());
        return out;
    };
    std::vector<bool> out(pieces_.size(), false);
    for (const EmissivePanel& panel : panels) {
        std::set<Corners> own;
        for (const glm::uvec3& triangle : panel.triangles) {
            own.insert(corners(triangle));
        }
        for (size_t i = 0; i < pieces_.size(); ++i) {
            const SurfacePart& part = parts_.parts[pieces_[i].part];
            const PointSurface& surface = parts_.surfaces[part.surface];
            out[i] = out[i] || (surface.node == panel.node && surface.instance == panel.instance &&
                                surface.primitive == panel.primitive &&
                                own.contains(corners(part.table->triangles[pieces_[i].index])));
        }
    }
    return out;
}

std::vector<EmitterSample> Emitters::sample(std::span<const glm::vec3> radiance,
                                            const std::vector<bool>& shown, size_t count,
                                            std::span<const EmissivePanel> panels, uint32_t seed) const {
    const uint32_t scrambling = numbered_seed(k_seed, seed);
    const std::vector<bool> taken = taken_by(panels);
    // Fronts of all pieces, then backs, so that either side is stratified for itself.
    std::vector<double> cumulative;
    cumulative.reserve(2 * pieces_.size());
    double sum = 0.0;
    for (const bool back : {false, true}) {
        for (size_t i = 0; i < pieces_.size(); ++i) {
            const Piece& piece = pieces_[i];
            const uint32_t surface = parts_.parts[piece.part].surface;
            const int material = primitive_of(scene_, parts_.surfaces[surface]).material;
            const bool sends = shown[surface] && (back ? piece.sides.back : piece.sides.front) && !taken[i];
            sum += sends ? area_m2(piece) * emitted_luminance(radiance[at(material)] * piece.texture) : 0.0;
            cumulative.push_back(sum);
        }
    }
    std::vector<EmitterSample> out;
    if (!(sum > 0.0) || !std::isfinite(sum)) {
        return out;
    }
    for (size_t i = 0; i < count; ++i) {
        const glm::dvec3 u = sobol_point(static_cast<uint32_t>(i), scrambling);
        const auto found = std::upper_bound(cumulative.begin(), cumulative.end(), u.x * sum);
        const size_t entry = std::min(static_cast<size_t>(found - cumulative.begin()), cumulative.size() - 1);
        const Piece& piece = pieces_[entry % pieces_.size()];
        const double weight = cumulative[entry] - (entry == 0 ? 0.0 : cumulative[entry - 1]);
        // Uniform over a triangle: Osada et al. 2002, "Shape Distributions".
        const double root = std::sqrt(u.y);
        const glm::vec2 place =
            piece.corners[0] +
            (piece.corners[1] - piece.corners[0]) * static_cast<float>(root * (1.0 - u.z)) +
            (piece.corners[2] - piece.corners[0]) * static_cast<float>(root * u.z);
        const double pieces_stood_for = sum / static_cast<double>(count) / weight;
        EmitterSample& sample = out.emplace_back();
        const SurfacePart& part = parts_.parts[piece.part];
        sample.point.surface = part.surface;
        sample.point.triangle = part.table->triangles[piece.index];
        sample.point.second = place.x;
        sample.point.third = place.y;
        sample.point.share = static_cast<float>(pieces_stood_for * static_cast<double>(piece.share));
        sample.point.flat = part.table->flat;
        sample.area_m2 = area_m2(piece) * pieces_stood_for;
        sample.back = entry >= pieces_.size();
        // The piece's mean and not the texel at the place, so that all samples send the same.
        sample.texture = piece.texture;
    }
    return out;
}

}  // namespace bounce::scene
