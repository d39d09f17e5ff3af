// SPDX-License-Identifier: Apache-2.0
#include "gpu/triangle_patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>

namespace bounce::gpu {
namespace {

size_t at(int index) {
    return static_cast<size_t>(index);
}

// A triangle's corners, whichever comes first.
std::array<uint32_t, 3> sorted(const glm::uvec3& triangle) {
    std::array<uint32_t, 3> out{triangle.x, triangle.y, triangle.z};
    std::sort(out.begin(), out.end());
    return out;
}

// How much a triangle's area grows under a transform, at most.
double area_scale(const glm::dmat4& m) {
    const glm::dvec3 x(m[0]);
    const glm::dvec3 y(m[1]);
    const glm::dvec3 z(m[2]);
    const glm::dvec3 yz = glm::cross(y, z);
    const glm::dvec3 zx = glm::cross(z, x);
    const glm::dvec3 xy = glm::cross(x, y);
    return std::sqrt(glm::dot(yz, yz) + glm::dot(zx, zx) + glm::dot(xy, xy));
}

// Of a triangle within a box: half of what its three projections have at most.
double largest_in(const DrawBox& box) {
    if (box.unknown()) {
        return std::numeric_limits<double>::infinity();
    }
    const glm::dvec3 side(box.high - box.low);
    return 0.5 * glm::length(glm::dvec3(side.x * side.y, side.y * side.z, side.z * side.x));
}

// Triangles of a batch in the order they are drawn in; corners without the base vertex.
std::vector<uint32_t> drawn_indices(const GpuScene& scene, const DrawBatch& batch) {
    return scene.vertices().indices().read<uint32_t>(batch.index_count,
                                                     size_t{batch.first_index} * sizeof(uint32_t));
}

}  // namespace

void TrianglePatches::set_pose(const scene::Pose& pose, const GpuScene& scene, PointStore& points,
                               bool drop_hull) {
    find_dropped(pose, scene, points, drop_hull);
    find_sizes(pose, scene);
    for (auto& runs : runs_) {
        runs.clear();
    }
    for (const DrawBatch& batch : scene.batches()) {
        runs_[static_cast<size_t>(PatchCover::all)].push_back({{batch.first_draw, batch.draw_count}});
        std::vector<Run>& runs = runs_[static_cast<size_t>(PatchCover::inside)].emplace_back();
        for (uint32_t draw = batch.first_draw; draw < batch.first_draw + batch.draw_count; ++draw) {
            if (words_[draw] == PATCH_KEEPS_NONE) {
                continue;
            }
            if (!runs.empty() && runs.back().first + runs.back().count == draw) {
                ++runs.back().count;
            } else {
                runs.push_back({draw, 1});
            }
        }
    }
}

void TrianglePatches::find_dropped(const scene::Pose& pose, const GpuScene& scene, PointStore& points,
                                   bool drop_hull) {
    const std::vector<bool> on_hull = points.on_hull(pose, drop_hull);
    const scene::SurfaceParts& parts = points.parts();
    // Parts of each surface, and which surface a draw is: by node, place among its draws, and primitive.
    std::vector<std::vector<size_t>> parts_of(parts.surfaces.size());
    for (size_t p = 0; p < parts.parts.size(); ++p) {
        parts_of[parts.parts[p].surface].push_back(p);
    }
    std::map<std::tuple<int, int, int>, size_t> surfaces;
    for (size_t s = 0; s < parts.surfaces.size(); ++s) {
        const scene::PointSurface& surface = parts.surfaces[s];
        surfaces.emplace(std::tuple(surface.node, surface.instance, surface.primitive), s);
    }
    std::vector<int> place(pose.draws.size());
    std::map<int, int> drawn;
    for (size_t i = 0; i < pose.draws.size(); ++i) {
        place[i] = drawn[pose.draws[i].node]++;
    }

    std::vector<size_t> drawn_surfaces;  // one a draw
    for (const DrawSource& source : scene.draw_sources()) {
        const auto found = surfaces.find(
            std::tuple(pose.draws[at(source.instance)].node, place[at(source.instance)], source.primitive));
        drawn_surfaces.push_back(found == surfaces.end() ? parts.surfaces.size() : found->second);
    }
    if (on_hull == on_hull_ && drawn_surfaces == drawn_surfaces_) {
        return;  // as at the pose before
    }
    std::vector<uint32_t> words(scene.draw_sources().size(), PATCH_KEEPS_ALL);
    bool drops = false;
    // Bits of one mesh's primitive with the same parts on the hull are the same.
    std::map<std::tuple<int, int, std::vector<size_t>>, uint32_t> known;
    for (const DrawBatch& batch : scene.batches()) {
        for (uint32_t draw = batch.first_draw; draw < batch.first_draw + batch.draw_count; ++draw) {
            if (drawn_surfaces[draw] == parts.surfaces.size()) {
                continue;
            }
            std::vector<size_t> hull;
            const std::vector<size_t>& own = parts_of[drawn_surfaces[draw]];
            for (size_t i = 0; i < own.size(); ++i) {
                if (on_hull[own[i]]) {
                    hull.push_back(i);
                }
            }
            if (hull.empty()) {
                continue;
            }
            if (hull.size() == own.size()) {
                words[draw] = PATCH_KEEPS_NONE;
                continue;
            }
            drops = true;
            const auto key = std::tuple(batch.mesh, batch.primitive, hull);
            if (const auto same = known.find(key); same != known.end()) {
                words[draw] = same->second;
                continue;
            }
            std::set<std::array<uint32_t, 3>> left_out;
            for (const size_t i : hull) {
                for (const glm::uvec3& triangle : parts.parts[own[i]].table->triangles) {
                    left_out.insert(sorted(triangle));
                }
            }
            const auto first = static_cast<uint32_t>(words.size());
            const std::vector<uint32_t> indices = drawn_indices(scene, batch);
            words.resize(words.size() + (indices.size() / 3 + 31) / 32, 0U);
            for (size_t t = 0; t < indices.size() / 3; ++t) {
                if (left_out.contains(sorted({indices[3 * t], indices[3 * t + 1], indices[3 * t + 2]}))) {
                    words[first + t / 32] |= 1U << (t % 32);
                }
            }
            words[draw] = first;
            known.emplace(key, first);
        }
    }
    drops_ = drops;
    if (drops) {
        dropped_ = gl::Buffer::of("dropped triangles", std::span<const uint32_t>(words));
    }
    words_ = std::move(words);
    on_hull_ = on_hull;
    drawn_surfaces_ = std::move(drawn_surfaces);
}

const TrianglePatches::Extent& TrianglePatches::extent(const scene::Scene& scene, int mesh, int primitive) {
    if (extents_.size() != scene.meshes.size()) {
        extents_.assign(scene.meshes.size(), {});
    }
    std::vector<Extent>& of_mesh = extents_[at(mesh)];
    const std::vector<scene::Primitive>& primitives = scene.meshes[at(mesh)].primitives;
    if (of_mesh.size() != primitives.size()) {
        of_mesh.assign(primitives.size(), {-1.0, 0.0});
    }
    Extent& out = of_mesh[at(primitive)];
    if (out.largest < 0.0) {
        out.largest = 0.0;
        const scene::Primitive& p = primitives[at(primitive)];
        for (size_t i = 0; i + 2 < p.indices.size(); i += 3) {
            const glm::dvec3 a(p.positions[p.indices[i]]);
            const glm::dvec3 b(p.positions[p.indices[i + 1]]);
            const glm::dvec3 c(p.positions[p.indices[i + 2]]);
            const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
            out.largest = std::max(out.largest, area);
            out.sum += area;
        }
    }
    return out;
}

void TrianglePatches::find_sizes(const scene::Pose& pose, const GpuScene& scene) {
    largest_.clear();
    areas_.clear();
    for (const DrawBatch& batch : scene.batches()) {
        double& largest = largest_.emplace_back(0.0);
        double& area = areas_.emplace_back(0.0);
        const Extent& model = extent(scene.source(), batch.mesh, batch.primitive);
        for (uint32_t draw = batch.first_draw; draw < batch.first_draw + batch.draw_count; ++draw) {
            const DrawSource& source = scene.draw_sources()[draw];
            const scene::DrawInstance& instance = pose.draws[at(source.instance)];
            if (scene.vertices().node_deforms(instance.node)) {
                largest = std::max(largest, largest_in(scene.draw_box(draw)));
                area = std::numeric_limits<double>::infinity();
                continue;
            }
            const double scale = area_scale(scene.render_from_vertices(instance, source.primitive));
            largest = std::max(largest, model.largest * scale);
            area = std::max(area, model.sum * scale);
        }
    }
}

}  // namespace bounce::gpu
