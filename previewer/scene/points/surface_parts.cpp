// SPDX-License-Identifier: Apache-2.0
#include "scene/points/surface_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "scene/points/deformed_positions.h"
#include "scene/points/flat_cover.h"
#include "scene/points/morton.h"
#include "scene/primitive_bounds.h"

namespace bounce::scene {
namespace {

size_t at(int index) {
    return static_cast<size_t>(index);
}

// A flat piece is followed on its own from this part of the scene's area on: smaller ones cost more to look
// after than their points cost.
constexpr double k_least_flat_share = 0.002;
// Triangles of one plane are taken together from here on (flat_cover.h). Smaller ones are never large
// triangles, but where points are many and most of the scene is on its hull.
constexpr double k_least_cover_share = 0.0002;

// Triangles count as one plane where normals agree to about half a degree and offsets to this part of the
// primitive's size.
constexpr double k_normal_steps = 128.0;
constexpr double k_offset_steps = 4096.0;

using Positions = std::vector<glm::dvec3>;

Positions model_positions(const Primitive& primitive) {
    return {primitive.positions.begin(), primitive.positions.end()};
}

using Triangles = std::vector<glm::uvec3>;

glm::uvec3 corners_of(const Primitive& primitive, size_t triangle) {
    const uint32_t* index = &primitive.indices[3 * triangle];
    return {index[0], index[1], index[2]};
}

// Twice the area as a vector along the normal.
glm::dvec3 area_vector(const Positions& p, const glm::uvec3& t) {
    return glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]);
}

// Triangles that lie near each other stand near each other, so that points even in area are even in space.
void sort_along_curve(const Positions& p, Triangles& triangles) {
    glm::dvec3 low(1e300);
    glm::dvec3 high(-1e300);
    for (const glm::dvec3& position : p) {
        low = glm::min(low, position);
        high = glm::max(high, position);
    }
    std::vector<std::pair<uint32_t, uint32_t>> keyed;
    keyed.reserve(triangles.size());
    for (const glm::uvec3& t : triangles) {
        const glm::dvec3 center = (p[t.x] + p[t.y] + p[t.z]) / 3.0;
        keyed.emplace_back(morton_in_box(center, low, high), static_cast<uint32_t>(keyed.size()));
    }
    std::sort(keyed.begin(), keyed.end());
    Triangles sorted;
    sorted.reserve(triangles.size());
    for (const auto& [code, triangle] : keyed) {
        sorted.push_back(triangles[triangle]);
    }
    triangles = std::move(sorted);
}

AreaTable make_table(const Positions& p, Triangles triangles) {
    AreaTable table;
    sort_along_curve(p, triangles);
    table.triangles = std::move(triangles);
    double sum = 0.0;
    for (const glm::uvec3& triangle : table.triangles) {
        const double length = 0.5 * glm::length(area_vector(p, triangle));
        const double area = std::isfinite(length) ? length : 0.0;
        sum += area;
        table.cumulative.push_back(sum);
        if (area > 0.0) {
            table.center += area / 3.0 * (p[triangle.x] + p[triangle.y] + p[triangle.z]);
        }
    }
    table.center /= std::max(sum, 1e-300);
    return table;
}

// Triangles of one primitive by the plane they lie in.
std::vector<std::vector<uint32_t>> triangles_by_plane(const Primitive& primitive, const Positions& p) {
    Bounds box;  // which may lie far from the origin
    for (const glm::dvec3& position : p) {
        box.grow(position);
    }
    const glm::dvec3 middle = box.empty() ? glm::dvec3(0.0) : box.center();
    const double offset_step = std::max(0.5 * box.diagonal(), 1e-300) / k_offset_steps;
    std::map<std::array<int64_t, 4>, std::vector<uint32_t>> planes;
    const auto count = static_cast<uint32_t>(primitive.indices.size() / 3);
    for (uint32_t triangle = 0; triangle < count; ++triangle) {
        const glm::uvec3 corners = corners_of(primitive, triangle);
        const glm::dvec3 area = area_vector(p, corners);
        const double length = glm::length(area);
        if (!(length > 0.0) || !std::isfinite(length)) {
            continue;  // a triangle without area is drawn nowhere and hides nothing
        }
        const glm::dvec3 normal = area / length;
        const double offset = glm::dot(normal, p[corners.x] - middle);
        planes[{std::llround(normal.x * k_normal_steps), std::llround(normal.y * k_normal_steps),
                std::llround(normal.z * k_normal_steps), std::llround(offset / offset_step)}]
            .push_back(triangle);
    }
    std::vector<std::vector<uint32_t>> out;
    for (auto& [plane, triangles] : planes) {
        out.push_back(std::move(triangles));
    }
    return out;
}

Triangles corners_of(const Primitive& primitive, const std::vector<uint32_t>& triangles) {
    Triangles out;
    out.reserve(triangles.size());
    for (const uint32_t triangle : triangles) {
        out.push_back(corners_of(primitive, triangle));
    }
    return out;
}

double sum_of_areas(const Primitive& primitive, const Positions& p, const std::vector<uint32_t>& triangles) {
    double sum = 0.0;
    for (const uint32_t triangle : triangles) {
        sum += 0.5 * glm::length(area_vector(p, corners_of(primitive, triangle)));
    }
    return sum;
}

// How a rigid transform scales areas: exactly where it scales all directions alike.
double area_scale(const glm::dmat4& m) {
    const glm::dvec3 x(m[0]);
    const glm::dvec3 y(m[1]);
    const glm::dvec3 z(m[2]);
    return std::sqrt((glm::dot(x, x) * glm::dot(y, y) + glm::dot(y, y) * glm::dot(z, z) +
                      glm::dot(z, z) * glm::dot(x, x)) /
                     3.0);
}

// Up to a hundredth. Axes of one length that are not square to each other (a turned child of an unevenly
// scaled parent) do not scale all directions alike.
bool scales_alike(const glm::dmat4& m) {
    const glm::dvec3 x(m[0]);
    const glm::dvec3 y(m[1]);
    const glm::dvec3 z(m[2]);
    const auto [low, high] = std::minmax({glm::length(x), glm::length(y), glm::length(z)});
    const double skew =
        std::max({std::abs(glm::dot(x, y)), std::abs(glm::dot(y, z)), std::abs(glm::dot(z, x))});
    return low > 0.0 && high < 1.01 * low && skew < 0.01 * low * low;
}

// Where a rigid surface stands at the moment its areas are taken from.
struct Placement {
    glm::dmat4 world_from_model{1.0};
    double scale = 0.0;
};

// The moments that areas are taken from.
std::vector<Pose> sample_poses(const Scene& scene, int animation) {
    constexpr int moments = 5;
    std::vector<Pose> poses;
    const double length = time_of_frame(scene.frames, scene.frames.end);
    for (int i = 0; i < moments; ++i) {
        poses.push_back(evaluate_pose(scene, length * i / (moments - 1), animation));
        if (!(length > 0.0)) {
            break;
        }
    }
    return poses;
}

class Cutter {
  public:
    Cutter(const Scene& scene, int animation) : scene_(scene), poses_(sample_poses(scene, animation)) {}

    SurfaceParts cut() {
        list_surfaces();
        find_box();
        find_total();
        for (size_t i = 0; i < out_.surfaces.size(); ++i) {
            add_parts(static_cast<uint32_t>(i));
        }
        sort_parts();
        return std::move(out_);
    }

  private:
    struct Piece {
        std::shared_ptr<const AreaTable> table;
        std::shared_ptr<const AreaTable> cover;
    };
    // A primitive's triangles cut once, in model space: one piece for each large plane and one for the rest.
    using Cut = std::vector<Piece>;

    void list_surfaces() {
        for (const int index : scene_.topological_order) {
            const Node& node = scene_.nodes[at(index)];
            if (node.mesh == k_none) {
                continue;
            }
            const Mesh& mesh = scene_.meshes[at(node.mesh)];
            // As evaluate_pose lists draws: a skinned mesh stands where its joints put it, once.
            const auto instances =
                node.skin != k_none ? 1 : std::max<int>(static_cast<int>(node.instances.size()), 1);
            for (int instance = 0; instance < instances; ++instance) {
                for (size_t p = 0; p < mesh.primitives.size(); ++p) {
                    const Primitive& primitive = mesh.primitives[p];
                    if (primitive.indices.empty()) {
                        continue;
                    }
                    const bool deforms = primitive_deforms(node, primitive);
                    out_.surfaces.push_back({index, instance, node.mesh, static_cast<int>(p), deforms});
                    placements_.push_back(largest_placement(node, index, instance));
                }
            }
        }
    }

    [[nodiscard]] Placement largest_placement(const Node& node, int index, int instance) const {
        Placement best;
        for (const Pose& pose : poses_) {
            glm::dmat4 m = node.skin != k_none ? glm::dmat4(1.0) : pose.world_from_node[at(index)];
            if (node.skin == k_none && !node.instances.empty()) {
                m = m * node.instances[at(instance)];
            }
            if (const double scale = area_scale(m); scale > best.scale && std::isfinite(scale)) {
                best = {m, scale};
            }
        }
        return best;
    }

    [[nodiscard]] const Primitive& primitive_of(const PointSurface& surface) const {
        return scene_.meshes[at(surface.mesh)].primitives[at(surface.primitive)];
    }

    const Positions& positions_of(const PointSurface& surface) {
        const auto key = std::pair(surface.mesh, surface.primitive);
        const auto found = positions_.find(key);
        return found != positions_.end()
                   ? found->second
                   : positions_.emplace(key, model_positions(primitive_of(surface))).first->second;
    }

    void find_box() {
        Bounds box;
        for (const Pose& pose : poses_) {
            box.grow(world_bounds(scene_, pose));
        }
        const glm::dvec3 side = box.empty() ? glm::dvec3(0.0) : box.high - box.low;
        out_.box_surface_m2 = 2.0 * (side.x * side.y + side.y * side.z + side.z * side.x);
    }

    void find_total() {
        std::map<std::pair<int, int>, double> model_areas;
        for (size_t i = 0; i < out_.surfaces.size(); ++i) {
            const PointSurface& surface = out_.surfaces[i];
            const Primitive& primitive = primitive_of(surface);
            const auto [entry, added] = model_areas.try_emplace({surface.mesh, surface.primitive}, 0.0);
            if (added) {
                std::vector<uint32_t> all(primitive.indices.size() / 3);
                std::iota(all.begin(), all.end(), 0U);
                entry->second = sum_of_areas(primitive, positions_of(surface), all);
            }
            const double area = entry->second * placements_[i].scale;
            total_ += std::isfinite(area) ? area : 0.0;
            double& largest = largest_scale_[{surface.mesh, surface.primitive}];
            largest = std::max(largest, placements_[i].scale);
        }
    }

    // positions: model space, or world space where `scale` is 1.
    [[nodiscard]] Cut cut_primitive(const Primitive& primitive, const Positions& positions, double scale,
                                    bool may_be_flat) const {
        Cut cut;
        std::vector<uint32_t> rest;
        std::vector<uint32_t> uncovered;  // of the rest
        Triangles covers;                 // in place of the others
        for (std::vector<uint32_t>& triangles : triangles_by_plane(primitive, positions)) {
            const double share =
                may_be_flat ? sum_of_areas(primitive, positions, triangles) * scale / total_ : 0.0;
            if (share >= k_least_flat_share) {
                cut.push_back(flat_piece(primitive, positions, corners_of(primitive, triangles)));
                continue;
            }
            rest.insert(rest.end(), triangles.begin(), triangles.end());
            const Triangles cover = share >= k_least_cover_share
                                        ? find_cover(primitive, positions, corners_of(primitive, triangles))
                                        : Triangles{};
            covers.insert(covers.end(), cover.begin(), cover.end());
            if (cover.empty()) {
                uncovered.insert(uncovered.end(), triangles.begin(), triangles.end());
            }
        }
        if (!rest.empty()) {
            cut.push_back(rest_piece(primitive, positions, std::move(rest), std::move(uncovered), covers));
        }
        return cut;
    }

    [[nodiscard]] static Piece rest_piece(const Primitive& primitive, const Positions& positions,
                                          std::vector<uint32_t> rest, std::vector<uint32_t> uncovered,
                                          const Triangles& covers) {
        const auto table_of = [&](std::vector<uint32_t> triangles, const Triangles& more) {
            std::sort(triangles.begin(), triangles.end());
            Triangles all = corners_of(primitive, triangles);
            all.insert(all.end(), more.begin(), more.end());
            return std::make_shared<const AreaTable>(make_table(positions, std::move(all)));
        };
        Piece piece{table_of(std::move(rest), {}), nullptr};
        piece.cover = covers.empty() ? piece.table : table_of(std::move(uncovered), covers);
        return piece;
    }

    // Where parts of triangles are not there, points tell which, by the coordinates of the triangle's own
    // corners: those have no cover.
    [[nodiscard]] Triangles find_cover(const Primitive& primitive, const Positions& positions,
                                       const Triangles& triangles) const {
        return cut_out(primitive) ? Triangles{} : flat_cover(positions, triangles);
    }

    [[nodiscard]] Piece flat_piece(const Primitive& primitive, const Positions& positions,
                                   Triangles triangles) const {
        Triangles cover = find_cover(primitive, positions, triangles);
        AreaTable table = make_table(positions, std::move(triangles));
        const auto model = [&](uint32_t vertex) { return glm::dvec3(primitive.positions[vertex]); };
        const glm::uvec3 first = table.triangles.front();
        table.flat = true;
        table.point = model(first.x);
        table.normal = glm::normalize(glm::cross(model(first.y) - table.point, model(first.z) - table.point));
        Piece piece{std::make_shared<const AreaTable>(std::move(table)), nullptr};
        piece.cover = piece.table;
        if (!cover.empty()) {
            AreaTable few = make_table(positions, std::move(cover));
            few.flat = true;
            few.point = piece.table->point;
            few.normal = piece.table->normal;
            piece.cover = std::make_shared<const AreaTable>(std::move(few));
        }
        return piece;
    }

    [[nodiscard]] bool cut_out(const Primitive& primitive) const {
        return primitive.material != k_none &&
               scene_.materials[at(primitive.material)].alpha_mode != AlphaMode::opaque;
    }

    // to_world: from the space of the cut's positions.
    void add_tables(uint32_t surface, const Cut& cut, double scale, const glm::dmat4& to_world) {
        const bool holes = cut_out(primitive_of(out_.surfaces[surface]));
        for (const Piece& piece : cut) {
            const double area = piece.table->cumulative.back() * scale;
            if (area > 0.0 && std::isfinite(area)) {
                const glm::dvec3 center(to_world * glm::dvec4(piece.table->center, 1.0));
                out_.parts.push_back({surface, piece.table, piece.cover, area, center, holes});
            }
        }
    }

    void add_parts(uint32_t index) {
        const PointSurface& surface = out_.surfaces[index];
        const Primitive& primitive = primitive_of(surface);
        const Placement& placement = placements_[index];
        if (surface.deforms) {
            add_tables(
                index,
                cut_primitive(primitive, deformed_positions(scene_, poses_.front(), surface), 1.0, false),
                1.0, glm::dmat4(1.0));
            return;
        }
        if (scales_alike(placement.world_from_model)) {
            const auto key = std::pair(surface.mesh, surface.primitive);
            auto found = cuts_.find(key);
            if (found == cuts_.end()) {
                found = cuts_
                            .emplace(key, cut_primitive(primitive, positions_of(surface), largest_scale_[key],
                                                        true))
                            .first;
            }
            add_tables(index, found->second, placement.scale, placement.world_from_model);
            return;
        }
        Positions world = positions_of(surface);
        for (glm::dvec3& position : world) {
            position = glm::dvec3(placement.world_from_model * glm::dvec4(position, 1.0));
        }
        add_tables(index, cut_primitive(primitive, world, 1.0, true), 1.0, glm::dmat4(1.0));
    }

    // Along a curve through their centres, the order that points are drawn in: near parts get near parts of a
    // sequence, whatever the order of the scene's nodes, meshes and materials.
    void sort_parts() {
        glm::dvec3 low(1e300);
        glm::dvec3 high(-1e300);
        for (const SurfacePart& part : out_.parts) {
            low = glm::min(low, part.center_world);
            high = glm::max(high, part.center_world);
        }
        const double longest = std::max({high.x - low.x, high.y - low.y, high.z - low.z, 1e-300});
        // Of parts in one cell: by their places to a millionth of the box, then by their areas.
        const auto fine = [&](double place) { return std::floor(place / longest * 1e6 + 0.618); };
        const auto key = [&](const SurfacePart& part) {
            const glm::dvec3 place = part.center_world - low;
            return std::tuple(morton_in_box(part.center_world, low, high), fine(place.x), fine(place.y),
                              fine(place.z), std::floor(std::log2(part.area_m2 / total_) * 64.0 + 0.618));
        };
        std::vector<std::pair<decltype(key(out_.parts.front())), size_t>> order;
        for (size_t i = 0; i < out_.parts.size(); ++i) {
            order.emplace_back(key(out_.parts[i]), i);
        }
        std::sort(order.begin(), order.end());
        std::vector<SurfacePart> sorted;
        sorted.reserve(order.size());
        for (const auto& [place, i] : order) {
            sorted.push_back(std::move(out_.parts[i]));
        }
        out_.parts = std::move(sorted);
    }

    const Scene& scene_;
    std::vector<Pose> poses_;
    std::vector<Placement> placements_;  // one a surface
    std::map<std::pair<int, int>, Positions> positions_;
    std::map<std::pair<int, int>, double> largest_scale_;
    std::map<std::pair<int, int>, Cut> cuts_;
    double total_ = 0.0;
    SurfaceParts out_;
};

}  // namespace

double SurfaceParts::area_m2() const {
    return std::accumulate(parts.begin(), parts.end(), 0.0,
                           [](double sum, const SurfacePart& part) { return sum + part.area_m2; });
}

SurfaceParts surface_parts(const Scene& scene, int animation) {
    return Cutter(scene, animation).cut();
}

}  // namespace bounce::scene
